// SPDX-License-Identifier: BSD-3-Clause
#include "tools/statistics_document.hpp"

#include <random>

#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tools;

namespace {

Json example(const char* name) { return parse_json(example_text(name), name); }

Json with_one_change(Json document, std::mt19937& random) {
  if (document.is_array() && document.size() > 0) {
    Json::Array elements = document.elements();
    const std::size_t at = random() % elements.size();
    switch (random() % 4) {
      case 0: elements.erase(elements.begin() + static_cast<std::ptrdiff_t>(at)); break;
      case 1: elements.insert(elements.begin() + static_cast<std::ptrdiff_t>(at), elements[at]); break;
      default: elements[at] = with_one_change(elements[at], random);
    }
    return elements;
  }
  if (document.is_object() && document.size() > 0) {
    Json::Members members = document.members();
    const std::size_t at = random() % members.size();
    if (random() % 8 == 0)
      members.erase(members.begin() + static_cast<std::ptrdiff_t>(at));
    else
      members[at].second = with_one_change(members[at].second, random);
    return members;
  }
  const Json odd[] = {Json(),      Json(-1),        Json(0),    Json(1e308),   Json(1e-308), Json(3),
                      Json("all"), Json("theta_h"), Json(true), Json::array(), Json(1 << 30)};
  return odd[random() % std::size(odd)];
}

}  // namespace

TEST_CASE("statistics that are written read back to the last bit") {
  for (const char* name : {"table.statistics.json", "directions.statistics.json"}) {
    const Json document = example(name);
    const Shard shard = statistics_from(document, name);
    CHECK(statistics_document(shard, document.at("context")) == document);
  }
}

TEST_CASE("columns of different length, and weights without samples, are refused with their places") {
  Json document = example("table.statistics.json");
  Json channel = document.at("channels")[0];
  Json::Array mean = channel.at("mean").elements(), counts = channel.at("count").elements();
  mean.pop_back();
  channel.set("mean", mean);
  document.set("channels", Json::Array{channel});
  try {
    statistics_from(document, "doc");
    FAIL("accepted");
  } catch (const Error& error) {
    REQUIRE(error.faults().size() == 1);
    CHECK(error.faults()[0].where == "doc#/channels/0/mean");
  }
  channel = example("table.statistics.json").at("channels")[0];
  counts[1] = 0;
  channel.set("count", counts);
  document.set("channels", Json::Array{channel});
  CHECK_THROWS_AS(statistics_from(document, "doc"), Error);
}

TEST_CASE("a file of samples cannot count twice") {
  const Shard shard = statistics_from(example("table.statistics.json"), "a");
  CHECK_NOTHROW(merge_shards({shard}, {"a"}));
  CHECK_THROWS_AS(merge_shards({shard, shard}, {"a", "b"}), Error);
}

TEST_CASE("mutated statistics are refused, or read and fitted to a result that has only numbers in it") {
  constexpr unsigned seed = 20261123;
  INFO("seed " << seed);
  std::mt19937 random(seed);
  int read = 0, refused = 0;
  for (int i = 0; i < 4000; ++i) {
    Json document = example(i % 2 ? "table.statistics.json" : "directions.statistics.json");
    for (auto changes = 1 + random() % 2; changes > 0; --changes) document = with_one_change(document, random);
    try {
      const Shard shard = merge_shards({statistics_from(document, "doc")}, {"doc"});
      ++read;
      if (read % 8 != 0) continue;
      fitting::FitOptions options;
      options.model = shard.statistics.depends_on == DependsOn::nothing ? "lambert"
                      : shard.statistics.depends_on == DependsOn::psi   ? "phong"
                                                                        : "blinn-phong";
      options.threads = 1;
      const fitting::FitResult result = fitting::fit(shard.statistics, options);
      for (const auto& parameter : result.parameters) CHECK(std::isfinite(parameter.value));
    } catch (const Error& error) {
      ++refused;
      CHECK((error.kind() == ErrorKind::input || error.kind() == ErrorKind::usage));
    }
  }
  CHECK(read > 100);
  CHECK(refused > 100);
}
