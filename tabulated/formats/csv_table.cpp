// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/csv_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "data-schemas/document.hpp"
#include "tabulated/formats/csv_text.hpp"

namespace gonio::tabulated {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

bool is_header(const std::vector<std::string_view>& fields) {
  return std::any_of(fields.begin(), fields.end(), [](std::string_view field) { return parse_number(field).fault != nullptr; });
}

/// Reads the rows under a layout; holds one row until it is known to be a sample.
class RowReader {
 public:
  RowReader(CsvTable& table, const ReadOptions& options, FaultList& faults)
      : table_(table), layout_(table.layout), missing_(options.missing), faults_(faults) {
    table_.values.resize(layout_.channels.size());
    if (layout_.has_uncertainty) table_.u.resize(layout_.channels.size());
    table_.extras.resize(layout_.extras.size());
    values_.resize(layout_.channels.size());
    u_.assign(layout_.channels.size(), unknown);
    extras_.resize(layout_.extras.size());
    for (const CsvLayout::Constant& constant : layout_.constants) place(constant.target) = constant.value;
  }

  void read(const std::vector<std::string_view>& fields, std::size_t line) {
    ++table_.row_count;
    if (fields.size() != layout_.columns.size()) {
      faults_.add_at(line, fmt::format("{} columns", fields.size()), fmt::format("{}, as in the first row", layout_.columns.size()));
      return;
    }
    bool sound = true;
    for (std::size_t k = 0; k < fields.size(); ++k) {
      if (layout_.columns[k].kind == CsvTarget::Kind::ignored) continue;
      const Number number = parse_number(fields[k]);
      if (number.fault != nullptr) {
        faults_.add_at(line, fmt::format("{} {} in column {}", number.fault, excerpt(fields[k]), k + 1),
                       "a finite number, or nan, NA or nothing");
        sound = false;
      }
      place(layout_.columns[k]) = number.value;
    }
    if (sound && !is_masked()) keep(line);
  }

 private:
  double& place(const CsvTarget& target) {
    switch (target.kind) {
      case CsvTarget::Kind::angle: return angles_[target.index];
      case CsvTarget::Kind::channel: return values_[target.index];
      case CsvTarget::Kind::uncertainty: return u_[target.index];
      case CsvTarget::Kind::extra: return extras_[target.index];
      case CsvTarget::Kind::wavelength: return wavelength_;
      case CsvTarget::Kind::ignored: break;
    }
    return nowhere_;
  }

  bool is_masked() {
    const auto all = [&](auto&& predicate) { return std::all_of(values_.begin(), values_.end(), predicate); };
    if (missing_ && all([&](double value) { return value == *missing_; })) return count(table_.masked.missing);
    if (all([](double value) { return std::isnan(value); }) ||
        std::any_of(angles_.begin(), angles_.end(), [](double angle) { return std::isnan(angle); }) || std::isnan(wavelength_))
      return count(table_.masked.nan);
    const bool wo_may_be_below = table_.metadata.description.side == Side::transmission;
    if (is_beyond_horizon(theta_i) || (!wo_may_be_below && is_beyond_horizon(theta_o))) return count(table_.masked.below_horizon);
    return false;
  }

  static bool count(std::size_t& counter) {
    ++counter;
    return true;
  }

  bool is_beyond_horizon(AngleIndex angle) const {
    const double value = std::fabs(angles_[angle]);
    return (layout_.in_radians[angle] ? radians(value).degrees() : value) > 90;
  }

  void keep(std::size_t line) {
    for (const double u : u_)
      if (u <= 0) faults_.add_at(line, fmt::format("a standard uncertainty of {}", u), "a positive number, or nan for unknown");
    const auto append = [](auto& columns, const auto& row) {
      for (std::size_t k = 0; k < columns.size(); ++k) columns[k].push_back(row[k]);
    };
    append(table_.angles, angles_);
    append(table_.values, values_);
    append(table_.u, u_);
    append(table_.extras, extras_);
    if (!(layout_.wavelength_unit_nm > 0)) return;
    if (wavelength_ <= 0) faults_.add_at(line, fmt::format("a wavelength of {}", wavelength_), "a positive wavelength");
    // Micrometres are written with few digits: 0.351 um is 351 nm, not 350.99999999999994.
    constexpr double digits = 1e9;
    const double nm = wavelength_ * layout_.wavelength_unit_nm;
    table_.wavelength_nm.push_back(layout_.wavelength_unit_nm == 1 ? nm : std::round(nm * digits) / digits);
  }

  CsvTable& table_;
  const CsvLayout& layout_;
  std::optional<double> missing_;
  FaultList& faults_;
  std::array<double, 4> angles_{};
  std::vector<double> values_, u_, extras_;
  double wavelength_ = 0, nowhere_ = 0;
};

}  // namespace

CsvTable read_csv_table(const std::filesystem::path& path, const ReadOptions& options) {
  FaultList faults(path.string());
  const std::string text = read_file(path);
  CsvTable table;

  // Comment lines up to the first row; the metadata of our own files stands there.
  CsvLines lines(text);
  std::optional<std::string_view> line = lines.next();
  for (; line && is_empty_line(*line); line = lines.next()) read_metadata_line(*line, lines.number(), table.metadata, faults);
  if (!line) {
    faults.add(path.string(), "no row", "at least one sample");
    faults.raise();
  }

  const char separator = separator_of(*line);
  std::vector<std::string_view> fields;
  split(*line, separator, fields);
  std::vector<std::string> header;
  if (is_header(fields)) {
    for (const std::string_view field : fields) header.push_back(unquoted(field));
    line = lines.next();
  }
  table.layout = layout_of(header, fields.size(), options, table.metadata, faults);
  faults.raise();

  RowReader rows(table, options, faults);
  for (; line; line = lines.next()) {
    split(*line, separator, fields);
    if (!fields.empty()) rows.read(fields, lines.number());
  }
  faults.raise();
  return table;
}

}  // namespace gonio::tabulated
