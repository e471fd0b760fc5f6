// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/csv_metadata.hpp"

#include <sstream>

#include "tests/tabulated/faults_text.hpp"
#include "tests/temporary_folder.hpp"

#include "tests/check.hpp"

using namespace gonio;
using namespace gonio::tabulated;
using gonio::test::faults_of;

namespace {

CsvMetadata read(const std::vector<std::string>& lines) {
  CsvMetadata metadata;
  FaultList faults("file.csv");
  for (std::size_t k = 0; k < lines.size(); ++k) read_metadata_line(lines[k], k + 1, metadata, faults);
  faults.raise();
  return metadata;
}

}  // namespace

TEST_CASE("Only a file with our signature in its first line is believed") {
  CHECK(read({"# gonio samples 1", "# symmetry: isotropic"}).description.symmetry.isotropic);
  CHECK_FALSE(read({"# symmetry: isotropic"}).description.symmetry.isotropic);
  CHECK_FALSE(read({"", "# gonio samples 1", "# symmetry: isotropic"}).ours);
}

TEST_CASE("A line of ours that cannot be read is a fault") {
  for (const char* line : {"# symmetry: round", "# side: top", "# simulated: maybe", "# aperture.spot_diameter_m: wide",
                           "# aperture.iris_m: 1", "# correlated.scale: -1", "# masked.nan: 1e300", "# masked.nan: -1",
                           "# channel.1.wavelength_in_nm: 550", "# channel.2: skipped", "# channel.x: no number", "# colour: red"})
    CHECK(faults_of([&] { read({"# gonio samples 1", line}); }).find("file.csv:2") != std::string::npos);
  CHECK(read({"# gonio samples 1", "# just words", "#: no key of ours"}).ours);
}

TEST_CASE("A channel keeps its wavelength and polarisation, whatever its name") {
  Dataset out;
  out.channels = single_channel("f.550: odd\\name");
  out.channels[0].wavelength_in_nm = 550.5;
  out.channels[0].bandwidth_nm = 10;
  out.channels[0].polarisation_in.emplace("s");
  const std::string text = metadata_lines(out);
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  CHECK(read(lines).description.channels == out.channels);
}
