// SPDX-License-Identifier: BSD-3-Clause
// Samples to CSV text.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "data-schemas/write_file.hpp"
#include "tabulated/formats/csv.hpp"
#include "tabulated/formats/csv_columns.hpp"
#include "tabulated/formats/csv_text.hpp"

namespace gonio::tabulated {
namespace {

constexpr std::array<Angle GonioAngles::*, 4> angle_members{&GonioAngles::theta_i, &GonioAngles::phi_i, &GonioAngles::theta_o,
                                                            &GonioAngles::phi_o};

/// A column is written in the unit its angles were made from, so that they read back bit for bit; degrees where both occur.
bool all_in_radians(const Dataset& dataset, Angle GonioAngles::*member) {
  return dataset.size() > 0 && std::none_of(dataset.angles.begin(), dataset.angles.end(),
                                            [&](const GonioAngles& angles) { return (angles.*member).made_from_degrees(); });
}

void require_writable_names(const Dataset& dataset, const std::filesystem::path& path) {
  FaultList faults(path.string());
  std::vector<std::string> names;
  const auto take = [&](const std::string& name, bool reserved) {
    if (reserved || name.empty() || name.find_first_of("\r\n") != std::string::npos ||
        std::find(names.begin(), names.end(), name) != names.end())
      faults.add(path.string(), fmt::format("a column named {}", excerpt(name)), "a name of its own, on one line");
    names.push_back(name);
  };
  for (const Channel& channel : dataset.channels)
    take(channel.name, angle_named(channel.name) || is_extra_name(channel.name) || channel.name.starts_with("u_"));
  for (const auto& [name, values] : dataset.extra) take(name, angle_named(name).has_value());
  for (const CorrelatedComponent& component : dataset.correlated)
    if (!component.sensitivity.empty()) take(fmt::format("c_{}", component.name), false);
  faults.raise();
}

}  // namespace

void write_csv(const Dataset& dataset, const std::filesystem::path& path) {
  dataset.require_consistent();
  require_writable_names(dataset, path);

  std::string text = metadata_lines(dataset);
  std::array<bool, 4> in_radians{};
  for (std::size_t k = 0; k < angle_members.size(); ++k) {
    in_radians[k] = all_in_radians(dataset, angle_members[k]);
    text += fmt::format("{}{}_{}", k == 0 ? "" : ",", angle_names[k], in_radians[k] ? "rad" : "deg");
  }
  std::vector<const std::vector<double>*> columns;
  const auto column = [&](const std::string& name, const std::vector<double>& values) {
    text += ',';
    text += as_field(name);
    columns.push_back(&values);
  };
  for (std::size_t c = 0; c < dataset.channels.size(); ++c) {
    column(dataset.channels[c].name, dataset.f[c]);
    if (dataset.has_uncertainty()) column(fmt::format("u_{}", dataset.channels[c].name), dataset.u[c]);
  }
  for (const CorrelatedComponent& component : dataset.correlated)
    if (!component.sensitivity.empty()) column(fmt::format("c_{}", component.name), component.sensitivity);
  for (const auto& [name, values] : dataset.extra) column(name, values);
  text += '\n';

  for (std::size_t row = 0; row < dataset.size(); ++row) {
    for (std::size_t k = 0; k < angle_members.size(); ++k) {
      const Angle& angle = dataset.angles[row].*angle_members[k];
      if (k > 0) text += ',';
      append_number(text, in_radians[k] ? angle.radians() : angle.degrees());
    }
    for (const std::vector<double>* values : columns) {
      text += ',';
      append_number(text, (*values)[row]);
    }
    text += '\n';
  }
  write_file_atomically(path, text);
}

}  // namespace gonio::tabulated
