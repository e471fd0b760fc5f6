// SPDX-License-Identifier: BSD-3-Clause
// Thousands of damaged CSV files: each is read or refused with an Error, never anything else.
#include <random>

#include "tabulated/formats/csv.hpp"
#include "tests/tabulated/damaged_text.hpp"
#include "tests/tabulated/faults_text.hpp"
#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;
using gonio::test::read_file;
using gonio::test::TemporaryFolder;

namespace {

const std::string plain =
    "theta_i_deg,phi_i_deg,theta_o_deg,phi_o_deg,value,u_value\n30,0,40,180,.5,.1\n30,0,-40,10,1e-3,nan\n30,0,90,180,-1,1\n";

std::string with_metadata(const TemporaryFolder& scratch) {
  Dataset data;
  data.channels = rgb_channels();
  data.channels[0].wavelength_in_nm = 550;
  data.angles = {{10_deg, 0_deg, 20_deg, 180_deg}, {30_deg, 0_deg, 20_deg, 180_deg}};
  data.f = {{1.0, 2.0}, {1.0, 2.0}, {1.0, 2.0}};
  data.u = data.f;
  data.correlated = {{"scale", 0.1, {1, 1}}};
  data.provenance = {{"who", "me"}};
  write_csv(data, scratch / "seed.csv");
  return read_file(scratch / "seed.csv");
}

}  // namespace

TEST_CASE("No damaged CSV file does more than raise an error") {
  const TemporaryFolder scratch;
  const std::string letters = std::string("0123456789.-+eE,;\t \"#\r\n\\:naNAinf") + std::string("\0\xff", 2);
  const auto [read, refused] = test::read_damaged({plain, with_metadata(scratch)}, letters, 20260703, 6000, [&](const std::string& text) {
    const Dataset data = read_csv(scratch.file("damaged.csv", text));
    data.require_consistent();
    REQUIRE(data.size() > 0);
  });
  CHECK(read > 200);  // the damage must not be so coarse that only one branch is tried
  CHECK(refused > 500);
}
