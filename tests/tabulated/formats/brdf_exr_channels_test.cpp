// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/brdf_exr_channels.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;

namespace {

Channels named(std::initializer_list<const char*> names) {
  Channels out;
  for (const char* name : names) out.push_back(single_channel(name).front());
  return out;
}

using Names = std::vector<std::string>;

}  // namespace

TEST_CASE("Viewers find R, G, B or Y; other channels keep their names") {
  CHECK(exr_channel_names(rgb_channels()) == Names{"R", "G", "B"});
  CHECK(exr_channel_names(named({"value"})) == Names{"Y"});
  CHECK(exr_channel_names(named({"450nm", "550nm"})) == Names{"f.450nm", "f.550nm"});
  CHECK(exr_channel_names(named({"b", "g", "r"})) == Names{"f.b", "f.g", "f.r"});
}

TEST_CASE("The channel to look at is nearest 555 nm, by wavelength or by name, else the first") {
  CHECK(exr_shown_channel(named({"400nm", "560nm", "540nm"})) == 1);
  CHECK(exr_shown_channel(named({"a", "b"})) == 0);
  Channels channels = named({"a", "b"});
  channels[1].wavelength_in_nm = 532;
  CHECK(exr_shown_channel(channels) == 1);
}
