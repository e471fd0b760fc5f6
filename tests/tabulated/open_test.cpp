// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/open.hpp"

#include <algorithm>
#include <set>

#include "tests/tabulated/faults_text.hpp"
#include "tests/tabulated/source_of_model.hpp"
#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;
using gonio::test::faults_of;
using gonio::test::TemporaryFolder;

TEST_CASE("A file is opened by what it holds, not by its name") {
  const TemporaryFolder scratch;
  const Opened opened = open_brdf(scratch.file("samples.bin", "theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg,value\n30,0,40,180,1\n"));
  CHECK(opened.format == "csv");
  REQUIRE(opened.dataset);
  CHECK(opened.dataset->size() == 1);
  REQUIRE(opened.observations);
  CHECK(opened.observations->block_count() == 1);
  CHECK_FALSE(opened.info.empty());
}

TEST_CASE("What cannot be a BRDF is refused with what was found") {
  const TemporaryFolder scratch;
  CHECK(faults_of([&] { open_brdf(scratch / "nothing"); }).find("no such file") != std::string::npos);
  CHECK(faults_of([&] { open_brdf(scratch.path()); }).find("not a file") != std::string::npos);
  CHECK(faults_of([&] { open_brdf(scratch.file("empty", "")); }).find("an empty file") != std::string::npos);
  CHECK(faults_of([&] { open_brdf(scratch.file("noise", std::string(100, '\1'))); }).find("100 bytes of an unknown kind") !=
        std::string::npos);
  ReadOptions options;
  options.format = "tiff";
  CHECK(faults_of([&] { open_brdf(scratch.file("x", "1 2 3"), options); }).find("usage|--format|tiff|one of ") == 0);
}

TEST_CASE("An answer to what a reader never asks is refused") {
  const TemporaryFolder scratch;
  ReadOptions options;
  options.assume["moon"] = "full";
  const auto samples = scratch.file("x.csv", "theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg,value\n30,0,40,180,1\n");
  CHECK(faults_of([&] { open_brdf(samples, options); }).find("usage|--assume moon|") == 0);
}

TEST_CASE("Every format has a name of its own, a description, and a reader or a writer") {
  for (const Format& format : formats()) {
    CHECK(std::string(format.description).size() > 10);
    CHECK((format.recognises == nullptr) == (format.open == nullptr));
    CHECK((format.open || format.write));
    if (format.write) CHECK(format.extension[0] == '.');
    CHECK(std::count_if(formats().begin(), formats().end(), [&](const Format& other) { return std::string(other.name) == format.name; }) ==
          1);
  }
}

TEST_CASE("Every reader says what a file holds, its unit, where values lie, its symmetry and its channels") {
  const TemporaryFolder scratch;
  const Opened source = test::source_of_model("phong", rgb_channels(), {{0.1, 0.3, 5}, {0.2, 0.2, 5}, {0.3, 0.1, 5}});
  WriteOptions options;
  options.size = GridSize::paper;
  std::set<std::string> said;
  for (const Format& format : formats()) {
    const std::string name = format.name;
    // The reader of these is the same as that of radiance-klems-quarter, and their files take seconds to write; a slice is a picture.
    if (!format.write || name == "exr-slice" || (name.starts_with("radiance-") && name != "radiance-klems-quarter")) continue;
    const std::filesystem::path path = scratch / (name + format.extension);
    ReadOptions answers;
    const ExportNotes notes = format.write(source, path, options);
    answers.assume = notes.assume;
    const Opened opened = open_brdf(notes.files.front(), answers);
    INFO(name << " read as " << opened.format);
    CHECK((!format.open || opened.format == name));
    said.insert(opened.format);
    for (const char* key : {"holds", "unit", "nodes", "symmetry", "channels"})
      CHECK(std::count_if(opened.info.begin(), opened.info.end(),
                          [&](const auto& fact) { return fact.first == key && !fact.second.empty(); }) == 1);
  }
  CHECK(said.size() >= 20);
}

TEST_CASE("A picture or a document that is no BRDF is refused with one fault") {
  const TemporaryFolder scratch;
  const Opened source = test::source_of_model("phong", single_channel("value"), {{0.1, 0.3, 5}});
  for (const Format& format : formats())
    if (std::string(format.name) == "exr-slice") format.write(source, scratch / "slice.exr", {});
  const std::string slice = faults_of([&] { open_brdf(scratch / "slice.exr"); });
  CHECK(slice.find("without the parts of a table") != std::string::npos);
  CHECK(std::count(slice.begin(), slice.end(), '\n') == 1);
  const std::string sidecar = faults_of([&] { open_brdf(scratch.file("x.json", "{\"context\": {}, \"format\": \"merl\"}")); });
  CHECK(sidecar.find("without a model and its parameters") != std::string::npos);
  CHECK(std::count(sidecar.begin(), sidecar.end(), '\n') == 1);
}
