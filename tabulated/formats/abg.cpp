// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/abg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <string>

#include "brdf/error.hpp"
#include "data-schemas/document.hpp"
#include "data-schemas/write_file.hpp"
#include "tabulated/describe.hpp"
#include "tabulated/fault_list.hpp"
#include "tabulated/formats/csv_text.hpp"
#include "tabulated/formats/keyword_text.hpp"
#include "tabulated/specular_angles.hpp"
#include "tabulated/values_to_write.hpp"

namespace gonio::tabulated {
namespace {

constexpr double incidences_deg[] = {0, 10, 20, 30, 40, 50, 60, 70, 80, 85};
constexpr int azimuth_count = 16, radial_count = 60;
constexpr double first_radial_deg = 0.01;

/// |β - β0| of a pair.
double beta_gap(const Direction& wi, const Direction& wo) { return std::hypot(wi.x() + wo.x(), wi.y() + wo.y()); }

std::vector<GonioAngles> poses_about(Angle theta_i, Side side) {
  std::vector<GonioAngles> out{from_specular(theta_i, 0_deg, {0, 0}, side)};
  for (int r = 0; r < radial_count; ++r) {
    const double radial = first_radial_deg * std::exp(std::log(180 / first_radial_deg) * r / (radial_count - 1));
    for (int a = 0; a < azimuth_count; ++a) {
      const GonioAngles pose = from_specular(theta_i, 0_deg, {radial, a * 360.0 / azimuth_count}, side);
      if (side == Side::reflection ? pose.theta_o.degrees() < 90 : pose.theta_o.degrees() > 90) out.push_back(pose);
    }
  }
  return out;
}

void append_row(std::string& text, const std::string& head, const AbgParameters& p) {
  text += head;
  for (const double value : {p.a, p.b, p.g}) {
    text += '\t';
    append_number(text, in_float_digits(value));
  }
  text += '\n';
}

std::string error_words(double rms_log) { return fmt::format("rms of ln f {:.3g} (a factor of {:.3g})", rms_log, std::exp(rms_log)); }

std::vector<AbgRow> read_rows(KeywordText& text, Channels& channels, FaultList& faults) {
  std::vector<AbgRow> out;
  AbgParameters all;
  bool has_all = false;
  const auto parameters = [&] {
    const std::size_t line = text.peek().line;
    AbgParameters p;
    p.a = text.number("A").value_or(0);
    if (faults.empty()) p.b = text.number("B").value_or(0);
    if (faults.empty()) p.g = text.number("g").value_or(0);
    if (faults.empty() && !(p.a >= 0 && p.b >= 0 && p.g >= 0 && p.b + p.g > 0 && (p.b > 0 || p.g == 0)))
      faults.add_at(line, fmt::format("A {}, B {}, g {}", p.a, p.b, p.g), "A >= 0, B > 0, g >= 0");
    return p;
  };
  while (faults.empty() && !text.at_end()) {
    const KeywordText::Word word = text.next();
    if (same_word(word.text, "NAME")) {
      text.next();
    } else if (same_word(word.text, "WAVE")) {
      const double um = text.number("a wavelength in um").value_or(0);
      if (um < 0) faults.add_at(word.line, fmt::format("WAVE {}", um), "a wavelength in um, or 0");
      constexpr double nm_per_um = 1000, digits = 1e9;
      if (um > 0) channels[0].wavelength_in_nm = channels[0].wavelength_out_nm = std::round(um * nm_per_um * digits) / digits;
    } else if (same_word(word.text, "ALL")) {
      all = parameters();
      has_all = true;
    } else if (same_word(word.text, "ANGLE")) {
      const double incidence = text.number("an angle of incidence").value_or(0);
      if (faults.empty() && !(incidence >= 0 && incidence <= 90 && (out.empty() || incidence > out.back().incidence_deg)))
        faults.add_at(word.line, fmt::format("ANGLE {}", incidence), "increasing angles from 0 to 90 degrees");
      if (faults.empty()) out.push_back({incidence, parameters()});
    } else {
      faults.add_at(word.line, excerpt(word.text), "NAME, WAVE, ALL or ANGLE");
    }
  }
  if (out.empty() && has_all) out.push_back({0, all});
  if (out.empty() && faults.empty()) faults.add(faults.file(), "no ANGLE and no ALL", "at least one set of A, B, g");
  return out;
}

}  // namespace

void AbgTable::eval(std::span<const Direction> wi, std::span<const Direction> wo, std::span<double> f) const {
  for (std::size_t k = 0; k < wi.size(); ++k) {
    if (!(wi[k].z() > 0) || !(wo[k].z() > 0)) {
      f[k] = 0;
      continue;
    }
    const double cosine = wi[k].z();
    const auto above =
        std::find_if(rows_.begin(), rows_.end(), [&](const AbgRow& row) { return degrees(row.incidence_deg).cos() < cosine; });
    AbgParameters p = above == rows_.end() ? rows_.back().parameters : above->parameters;
    if (above != rows_.begin() && above != rows_.end()) {
      const AbgRow& below = *(above - 1);
      const double low = degrees(below.incidence_deg).cos(), high = degrees(above->incidence_deg).cos(), w = (cosine - low) / (high - low);
      const AbgParameters& q = below.parameters;
      p = {q.a + w * (p.a - q.a), q.b + w * (p.b - q.b), q.g + w * (p.g - q.g)};
    }
    f[k] = p.at(beta_gap(wi[k], wo[k]));
  }
}

bool recognises_abg(std::string_view head, std::uintmax_t) {
  return has_keyword_line(head, "NAME") && has_keyword_line(head, "WAVE") &&
         (has_keyword_line(head, "ANGLE") || has_keyword_line(head, "ALL"));
}

Opened open_abg(const std::filesystem::path& path, const ReadOptions&) {
  FaultList faults(path.string());
  const std::string bytes = read_file(path);
  KeywordText text(bytes, faults);
  Channels channels = single_channel("value");
  std::vector<AbgRow> rows = read_rows(text, channels, faults);
  faults.raise();
  Opened out;
  out.format = "abg";
  out.info = {{"holds", "f, cosine not included"},
              {"unit", "1/sr"},
              {"nodes", fmt::format("none: A, B, g at {} incidences, linear in cos theta_i between them", rows.size())},
              {"symmetry", rows.size() == 1 ? "isotropic, bilateral, reciprocal by construction" : "isotropic, bilateral by construction"}};
  for (const AbgRow& row : rows)
    out.info.emplace_back(fmt::format("{} deg", row.incidence_deg),
                          fmt::format("A {:.6g}, B {:.6g}, g {:.6g}", row.parameters.a, row.parameters.b, row.parameters.g));
  out.info.emplace_back("channels", joined_names(channels));
  out.brdf = std::make_shared<const AbgTable>(std::move(rows), std::move(channels));
  return out;
}

ExportNotes write_abg(const Opened& source, const std::filesystem::path& path, const WriteOptions& options) {
  if (!source.brdf)
    throw Error(ErrorKind::input, {path.string(), fmt::format("a {} that cannot be evaluated", source.format), "a model or a table"});
  ExportNotes notes;
  notes.files = {path};
  const Side side = source.side;
  const ChannelMap map = one_channel(source.brdf->channels());
  std::vector<GonioAngles> poses;
  std::vector<std::size_t> first;
  for (const double incidence : incidences_deg) {
    first.push_back(poses.size());
    const std::vector<GonioAngles> about = poses_about(degrees(incidence), side);
    poses.insert(poses.end(), about.begin(), about.end());
  }
  first.push_back(poses.size());
  const std::vector<double> f = values_to_write(source, poses, map, options.threads, notes)[0];
  std::vector<double> x;
  for (const GonioAngles& pose : poses) x.push_back(beta_gap(pose.wi(), pose.wo()));

  const AbgFit all = fit_abg(x, f);
  double um = 0;
  if (map.to[0].wavelength_in_nm) um = *map.to[0].wavelength_in_nm / 1000;
  std::string text = fmt::format(
      "# ABg parameters, f = A / (B + |beta - beta0|^g) in 1/sr, fitted by gonio to {}\n"
      "# OpticStudio: enter WAVE (um) and the ANGLE rows in an ABg scatter data catalog. FRED: enter ALL in an ABg scatter model.\n"
      "NAME\tgonio\nWAVE\t{}\n",
      source.format, um);
  append_row(text, "ALL", all.parameters);
  std::size_t rows = 0;
  for (std::size_t i = 0; i + 1 < first.size(); ++i) {
    const std::size_t count = first[i + 1] - first[i];
    const std::span<const double> values = std::span(f).subspan(first[i], count);
    if (std::count_if(values.begin(), values.end(), [](double value) { return value > 0; }) < least_abg_samples) {
      notes.lost.push_back(fmt::format("{} deg: too few positive values for a fit", incidences_deg[i]));
      continue;
    }
    const AbgFit fit = fit_abg(std::span(x).subspan(first[i], count), values);
    append_row(text, fmt::format("ANGLE\t{}", incidences_deg[i]), fit.parameters);
    notes.facts.emplace_back(fmt::format("error at {} deg", incidences_deg[i]), error_words(fit.rms_log));
    ++rows;
  }
  notes.facts.emplace_back("error of one set for all", error_words(all.rms_log));
  notes.facts.emplace_back("rows", fmt::format("{} incidences; OpticStudio interpolates linearly in cos theta_i", rows));
  notes.lost.emplace_back("everything but a fit of three numbers per incidence; mind the remaining errors");
  notes.lost.emplace_back("a text to copy from: the layout of OpticStudio's own catalog file is not published");
  if (notes.n_unknown + notes.n_negative > 0) notes.lost.emplace_back("unknown and not positive values are left out of the fits");
  write_file_atomically(path, text);
  return notes;
}

}  // namespace gonio::tabulated
