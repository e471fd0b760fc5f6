// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/sample_table.hpp"

#include <cmath>
#include <limits>

#include "tests/tabulated/faults_text.hpp"
#include "tests/tabulated/one_channel.hpp"
#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;
using gonio::test::faults_of;

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr double rounding_only = 1e-15;

}  // namespace

TEST_CASE("Rows are incident and columns outgoing directions in order, and a cell nobody measured is NaN with count 0") {
  const SampleTable table = tabulate(
      test::one_channel({{30_deg, 0_deg, 50_deg, 180_deg}, {10_deg, 0_deg, 40_deg, 180_deg}, {10_deg, 0_deg, 50_deg, 180_deg}}, {3, 1, 2}));
  REQUIRE(table.incident.size() == 2);
  REQUIRE(table.outgoing.size() == 2);
  CHECK(table.incident[0].theta_deg == 10);
  CHECK(table.outgoing[1].theta_deg == 50);
  CHECK(table.f[0][0] == 1);
  CHECK(table.f[0][1] == 2);
  CHECK(table.f[0][3] == 3);
  CHECK(std::isnan(table.f[0][2]));
  CHECK(table.count[0] == std::vector<std::uint32_t>{1, 1, 0, 1});
  CHECK(table.is_empty(2));
  CHECK_FALSE(table.is_empty(3));
  CHECK(samples_of(table).size() == 3);
}

TEST_CASE("Repeats become their weighted mean where u is known, else their plain mean") {
  const GonioAngles same{30_deg, 0_deg, 50_deg, 180_deg};
  const SampleTable weighted = tabulate(test::one_channel({same, same}, {1, 4}, {1, 0.5}));
  CHECK(weighted.f[0][0] == Approx((1 + 4 * 4) / 5.0).epsilon(rounding_only));
  CHECK(weighted.u[0][0] == Approx(1 / std::sqrt(5)).epsilon(rounding_only));
  CHECK(weighted.count[0][0] == 2);
  CHECK(samples_of(weighted).extra.at("n")[0] == 2);
  const SampleTable plain = tabulate(test::one_channel({same, same}, {1, 4}, {1, unknown}));
  CHECK(plain.f[0][0] == 2.5);
  CHECK(std::isnan(plain.u[0][0]));
  const SampleTable partial = tabulate(test::one_channel({same, same}, {1, unknown}, {0.3, unknown}));
  CHECK(partial.f[0][0] == 1);
  CHECK(partial.u[0][0] == 0.3);
  CHECK(partial.count[0][0] == 1);
}

TEST_CASE("Poses that miss their asked direction by counts of the drive are one row, and come back as they were") {
  const double count = 1e-6;
  const Dataset in = test::one_channel(
      {{30_deg, 0_deg, 50_deg, 180_deg}, {degrees(30 + count), degrees(-count), degrees(60 - count), degrees(180 + count)}}, {1, 2});
  const SampleTable table = tabulate(in);
  CHECK(table.incident.size() == 1);
  CHECK(table.outgoing.size() == 2);
  const Dataset out = samples_of(table);
  REQUIRE(out.size() == 2);
  for (std::size_t k = 0; k < 2; ++k) {
    CHECK(std::fabs(out.angles[k].theta_i.degrees() - in.angles[k].theta_i.degrees()) < 1e-13);
    CHECK(std::fabs(out.angles[k].phi_i.degrees() - in.angles[k].phi_i.degrees()) < 1e-13);
    CHECK(out.angles[k].theta_o.degrees() == in.angles[k].theta_o.degrees());
    CHECK(out.angles[k].phi_o.degrees() == in.angles[k].phi_o.degrees());
  }
}

TEST_CASE("Scattered samples make no table") {
  Dataset scattered = test::one_channel({}, {});
  for (int k = 0; k < 5000; ++k) {
    scattered.angles.push_back({degrees(0.01 * k), 0_deg, degrees(90 - 0.01 * k), 180_deg});
    scattered.f[0].push_back(1);
  }
  CHECK(faults_of([&] { tabulate(scattered); }).find("5000 incident and 5000 outgoing directions") != std::string::npos);
}
