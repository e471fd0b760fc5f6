// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/tensor_file.hpp"

#include "tests/tabulated/faults_text.hpp"
#include "tests/tabulated/tensor_writer.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

namespace {

std::vector<Tensor> read(const std::string& file, FaultList& faults) { return read_tensors(std::as_bytes(std::span(file)), faults); }

std::string faults_in(const std::string& file) {
  return test::faults_of([&] {
    FaultList faults("x");
    read(file, faults);
    faults.raise();
  });
}

}  // namespace

TEST_CASE("Named arrays come back with their type, shape and numbers") {
  const std::string file = test::tensor_file({test::bytes("words", "hello"), test::floats("m", {2, 3}, {1, 2, 3, 4, 5, 6.5f})});
  FaultList faults("x");
  const auto tensors = read(file, faults);
  REQUIRE(faults.empty());
  REQUIRE(tensors.size() == 2);
  CHECK(tensors[0].name == "words");
  CHECK(tensors[0].text() == "hello");
  CHECK(tensors[1].type == TensorType::f32);
  CHECK(tensors[1].shape == std::vector<std::size_t>{2, 3});
  CHECK(tensors[1].floats() == std::vector<float>{1, 2, 3, 4, 5, 6.5f});
}

TEST_CASE("A damaged container names every fault and never reads beyond its end") {
  const auto field = test::floats("m", {2}, {1, 2});
  CHECK(faults_in("something else").find("tensor_file") != std::string::npos);
  CHECK(faults_in(std::string(tensor_file_signature)).find("version") != std::string::npos);
  std::string version = test::tensor_file({field});
  version[12] = 2;
  CHECK(faults_in(version).find("version 2.0") != std::string::npos);
  CHECK(faults_in(test::tensor_file({field, field})).find("second field") != std::string::npos);
  CHECK(faults_in(test::tensor_file({field}).substr(0, 30)).find("breaks off after 0") != std::string::npos);

  auto far = field, wide = field, kind = field;
  far.shape = {3};
  wide.shape = {std::uint64_t{1} << 62, 16};  // the product wraps around
  kind.type = 12;
  far.name = "far", wide.name = "wide", kind.name = "kind";
  const std::string all = faults_in(test::tensor_file({kind, wide, far}));
  for (const char* word : {"'kind'", "type 12", "'wide'", "'far'", "ends within the file"}) CHECK(all.find(word) != std::string::npos);
}
