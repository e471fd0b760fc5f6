// SPDX-License-Identifier: BSD-3-Clause
// Writing files of pab's goniophotometers, one per incidence.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <system_error>
#include <vector>

#include "brdf/error.hpp"
#include "data-schemas/write_file.hpp"
#include "tabulated/direction_grid.hpp"
#include "tabulated/formats/csv_text.hpp"
#include "tabulated/formats/pab.hpp"
#include "tabulated/values_to_write.hpp"

namespace gonio::tabulated {
namespace {

/// Samples in the channels of the file.
struct Samples {
  std::vector<GonioAngles> angles;
  std::vector<std::vector<double>> f;  ///< [channel][sample]
};

Samples samples_of(const Opened& source, const ChannelMap& map, const WriteOptions& options, ExportNotes& notes) {
  Samples out;
  if (!source.dataset) {
    if (!source.brdf)
      throw Error(ErrorKind::input, {"the source", fmt::format("a {} that cannot be evaluated", source.format), "a model or a table"});
    // pabopto2bsdf knows no plane of symmetry of an isotropic sample: the full turn.
    const DirectionGrid grid = direction_grid(options.size, {.isotropic = source.brdf->symmetry().isotropic});
    out.angles = grid.pairs();
    out.f = values_to_write(source, out.angles, map, options.threads, notes);
    return out;
  }
  out.angles = source.dataset->angles;
  out.f.assign(map.to.size(), {});
  if (!map.changed.empty()) notes.lost.push_back(map.changed);
  std::vector<double> from(source.dataset->channels.size()), to(map.to.size());
  for (std::size_t k = 0; k < out.angles.size(); ++k) {
    for (std::size_t c = 0; c < from.size(); ++c) from[c] = source.dataset->f[c][k];
    map.apply(from.data(), to.data());
    for (std::size_t c = 0; c < to.size(); ++c) out.f[c].push_back(to[c]);
  }
  notes.n_nodes += out.angles.size();
  if (source.dataset->has_uncertainty()) notes.lost.emplace_back("uncertainties have no place in the format");
  return out;
}

std::string header(const GonioAngles& at, const ChannelMap& map, const std::string& name) {
  std::string out = fmt::format("#sample_name \"{}\"\n", name);
  if (map.to.size() == 3)
    out += "#colorimetry: CIE-XYZ\n";
  else if (map.to[0].name == "Y")
    out += "#colorimetry: CIE-Y\n";
  out += "#format: theta phi BSDF\n#incident_angle ";
  append_number(out, at.theta_i.degrees());
  out += ' ';
  append_number(out, at.phi_i.degrees());
  return out + "\n#upphi 90\n";  // y is up: Radiance then keeps the azimuths as they are
}

std::filesystem::path numbered(const std::filesystem::path& path, std::size_t number) {
  if (number == 1) return path;
  std::filesystem::path out = path;
  return out.replace_filename(fmt::format("{}-{:03}{}", path.stem().string(), number, path.extension().string()));
}

}  // namespace

ExportNotes write_pab(const Opened& source, const std::filesystem::path& path, const WriteOptions& options) {
  const Channels& channels = source.dataset ? source.dataset->channels : source.brdf ? source.brdf->channels() : Channels{};
  ExportNotes notes;
  const ChannelMap map = one_channel_or_xyz(channels);
  const Samples samples = samples_of(source, map, options, notes);

  // In the order of the incidences' first samples.
  std::map<std::pair<double, double>, std::size_t> number;
  std::vector<std::string> texts;
  std::size_t left_out = 0, negative = 0;
  std::string name = path.stem().string();
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == '"' || static_cast<unsigned char>(c) < ' '; }, '_');
  for (std::size_t k = 0; k < samples.angles.size(); ++k) {
    const GonioAngles& at = samples.angles[k];
    const auto any = [&](auto&& predicate) {
      return std::any_of(samples.f.begin(), samples.f.end(), [&](const std::vector<double>& column) { return predicate(column[k]); });
    };
    if (any([](double value) { return std::isnan(value); })) {
      ++left_out;
      continue;
    }
    negative += any([](double value) { return value < 0; }) ? 1 : 0;
    const auto [incidence, is_new] = number.try_emplace({at.theta_i.degrees(), at.phi_i.degrees()}, texts.size());
    if (is_new) texts.push_back(header(at, map, name));
    std::string& text = texts[incidence->second];
    append_number(text, at.theta_o.degrees());
    text += ' ';
    append_number(text, at.phi_o.degrees());
    for (const std::vector<double>& column : samples.f) {
      text += ' ';
      append_number(text, std::max(0.0, column[k]));
    }
    text += '\n';
  }
  if (texts.empty()) throw Error(ErrorKind::input, {path.string(), "no sample that is known in every channel", "at least one"});

  try {
    for (std::size_t k = 0; k < texts.size(); ++k) {
      write_file_atomically(numbered(path, k + 1), texts[k]);
      notes.files.push_back(numbered(path, k + 1));
    }
  } catch (...) {
    std::error_code ignored;
    for (const std::filesystem::path& file : notes.files) std::filesystem::remove(file, ignored);
    throw;
  }
  notes.facts.emplace_back("incidences", fmt::format("{}, one file each", texts.size()));
  notes.facts.emplace_back("values", "BSDF, theta and phi in degrees, y up (#upphi 90)");
  if (left_out > 0) notes.lost.push_back(fmt::format("{} samples that are not known in every channel are left out", left_out));
  if (negative > 0) notes.lost.push_back(fmt::format("{} samples with a negative value have 0 there", negative));
  if (texts.size() < 2) notes.lost.emplace_back("pabopto2bsdf wants at least two incidences");
  return notes;
}

}  // namespace gonio::tabulated
