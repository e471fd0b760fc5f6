// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/cornell.hpp"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "data-schemas/document.hpp"
#include "tabulated/fault_list.hpp"
#include "tabulated/formats/keyword_text.hpp"
#include "tabulated/formats/stated_symmetry.hpp"
#include "tabulated/opened_samples.hpp"

namespace gonio::tabulated {

Dataset read_cornell(const std::filesystem::path& path, const ReadOptions& options) {
  FaultList faults(path.string());
  const std::string bytes = read_file(path);
  KeywordText text(bytes, faults);
  Dataset out;
  const std::vector<double> wavelengths = text.counted_list("wavelengths in nm");
  for (std::size_t k = 0; k < wavelengths.size(); ++k) {
    if (!(wavelengths[k] > 0) || (k > 0 && !(wavelengths[k] > wavelengths[k - 1])))
      faults.add(faults.file(), fmt::format("wavelength {}", wavelengths[k]), "increasing positive wavelengths");
    out.channels.push_back(single_channel(fmt::format("{}nm", wavelengths[k])).front());
    out.channels.back().wavelength_in_nm = out.channels.back().wavelength_out_nm = wavelengths[k];
  }
  faults.raise();
  out.f.resize(wavelengths.size());
  // Six decimals of pi/2 lie beyond it by 3e-7.
  constexpr double horizon = std::numbers::pi / 2 + 1e-6;
  std::vector<double> row(4 + wavelengths.size());
  while (!text.at_end()) {
    const std::size_t line = text.peek().line;
    for (double& number : row) {
      const auto read = text.number("an angle in radians or a value in 1/sr");
      if (!read) break;
      number = *read;
    }
    faults.raise();  // numbers of a row that is cut short would be taken for another
    if (row[0] < 0 || row[0] > horizon || row[2] < 0 || row[2] > horizon)
      faults.add_at(line, fmt::format("theta {} and {}", row[0], row[2]), "0 to pi/2");
    out.angles.push_back({radians(row[0]), radians(row[1]), radians(row[2]), radians(row[3])});
    for (std::size_t c = 0; c < wavelengths.size(); ++c) out.f[c].push_back(row[4 + c]);
  }
  if (faults.empty() && out.size() == 0) faults.add(faults.file(), "no sample", "at least one");
  faults.raise();
  out.symmetry = stated_symmetry(path, options);
  out.provenance["source"] = path.filename().string();
  for (const std::string& comment : text.comments()) {
    const std::size_t first = comment.find_first_not_of(' ');
    if (first == std::string::npos || text.comments().size() > 16) continue;
    if (comment.find("num wls") != std::string::npos) break;
    out.provenance["comments"] += (out.provenance["comments"].empty() ? "" : "; ") + comment.substr(first);
  }
  return out;
}

bool recognises_cornell(std::string_view head, std::uintmax_t) {
  return head.starts_with('#') && head.find("# num wls") != std::string_view::npos &&
         head.find("# theta i, phi i, theta s") != std::string_view::npos;
}

Opened open_cornell(const std::filesystem::path& path, const ReadOptions& options) {
  Opened out = opened_samples("cornell", std::make_shared<const Dataset>(read_cornell(path, options)));
  out.info.insert(out.info.begin(),
                  {{"holds", "f, cosine not included"}, {"unit", "1/sr"}, {"nodes", "at samples; specular is phi_s - phi_i = 180 deg"}});
  return out;
}

}  // namespace gonio::tabulated
