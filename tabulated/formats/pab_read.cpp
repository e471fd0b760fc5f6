// SPDX-License-Identifier: BSD-3-Clause
// Opening files of pab's goniophotometers.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "data-schemas/document.hpp"
#include "tabulated/fault_list.hpp"
#include "tabulated/formats/csv_text.hpp"
#include "tabulated/formats/keyword_text.hpp"
#include "tabulated/formats/pab.hpp"
#include "tabulated/opened_samples.hpp"
#include "tabulated/quantity.hpp"

namespace gonio::tabulated {
namespace {

struct Header {
  std::optional<Quantity> quantity;
  std::optional<double> theta_i_deg, phi_i_deg;
  std::size_t values = 1;
  std::string sample, up_phi, colorimetry;
};

struct Row {
  double theta_deg, phi_deg;
  std::vector<double> values;
};

/// Reads the lines and collects what is wrong with them.
class FileReader {
 public:
  explicit FileReader(FaultList& faults) : faults_(faults) {}

  void read(std::string_view text) {
    CsvLines lines(text);
    while (const auto line = lines.next()) {
      number_ = lines.number();
      if (line->starts_with('#'))
        read_key(line->substr(1));
      else if (!is_empty_line(*line))
        read_row(*line);
    }
    if (!header_.quantity) faults_.add(faults_.file(), "no usable #format", "#format: theta phi BSDF or DSF");
    if (!header_.theta_i_deg || !header_.phi_i_deg)
      faults_.add(faults_.file(), "no incident direction", "#incident_angle THETA PHI, or #intheta and #inphi");
    if (rows_.empty()) faults_.add(faults_.file(), "no row of numbers", "theta phi value");
  }

  const Header& header() const noexcept { return header_; }
  const std::vector<Row>& rows() const noexcept { return rows_; }
  std::size_t nan() const noexcept { return nan_; }

 private:
  void read_key(std::string_view line) {
    split(line, blanks, fields_);
    if (fields_.empty()) return;
    const std::string_view key = fields_[0];
    const auto angle = [&](std::size_t k, double limit, std::optional<double>& out) {
      const Number number = k < fields_.size() ? parse_number(fields_[k]) : Number{0, "nothing"};
      if (number.fault || !(std::fabs(number.value) <= limit))
        faults_.add_at(number_, excerpt(line), fmt::format("an angle of at most {}°", limit));
      else
        out = number.value;
    };
    if (key == "incident_angle") {
      angle(1, 180, header_.theta_i_deg);
      angle(2, 720, header_.phi_i_deg);
    } else if (key == "intheta") {
      angle(1, 180, header_.theta_i_deg);
    } else if (key == "inphi") {
      angle(1, 720, header_.phi_i_deg);
    } else if (key == "format:") {
      read_format(line);
    } else if (key == "colorimetry:" && fields_.size() > 1) {
      header_.colorimetry = std::string(fields_[1]);
      if (same_word(fields_[1], "CIE-XYZ"))
        header_.values = 3;
      else if (!same_word(fields_[1], "CIE-Y"))
        faults_.add_at(number_, excerpt(line), "CIE-Y or CIE-XYZ");
    } else if (key == "sample_name") {
      const std::size_t first = line.find('"'), last = line.rfind('"');
      if (first < last) header_.sample = std::string(line.substr(first + 1, last - first - 1));
    } else if (key == "upphi" && fields_.size() > 1) {
      header_.up_phi = std::string(fields_[1]);
    }
  }

  void read_format(std::string_view line) {
    const bool angles = fields_.size() == 4 && fields_[1] == "theta" && fields_[2] == "phi";
    if (angles && same_word(fields_[3], "DSF"))
      header_.quantity = Quantity::f_cos;
    else if (angles && (same_word(fields_[3], "BSDF") || same_word(fields_[3], "BRDF") || same_word(fields_[3], "BTDF")))
      header_.quantity = Quantity::f;
    else
      faults_.add_at(number_, excerpt(line), "format: theta phi and BSDF, BRDF, BTDF or DSF");
  }

  void read_row(std::string_view line) {
    split(line, blanks, fields_);
    if (fields_.size() != 2 + header_.values) {
      faults_.add_at(number_, fmt::format("{} numbers", fields_.size()), fmt::format("theta, phi and {} values", header_.values));
      return;
    }
    std::vector<double> numbers;
    for (const std::string_view field : fields_) {
      const Number number = parse_number(field);
      if (number.fault || std::isinf(number.value)) {
        faults_.add_at(number_, excerpt(field), "a number");
        return;
      }
      numbers.push_back(number.value);
    }
    if (!std::isnan(numbers[0]) && !(numbers[0] >= 0 && numbers[0] <= 180)) {
      faults_.add_at(number_, fmt::format("theta {}", numbers[0]), "0 to 180");
      return;
    }
    if (std::any_of(numbers.begin(), numbers.end(), [](double value) { return std::isnan(value); }))
      ++nan_;
    else
      rows_.push_back({numbers[0], numbers[1], {numbers.begin() + 2, numbers.end()}});
  }

  FaultList& faults_;
  Header header_;
  std::vector<Row> rows_;
  std::vector<std::string_view> fields_;
  std::size_t number_ = 0, nan_ = 0;
};

/// The side of the rows, asked for if there are both.
Side side_of_rows(const std::vector<Row>& rows, bool from_below, const ReadOptions& options, const std::string& file) {
  const auto answer = options.assumed("side");
  if (answer) {
    if (*answer == "reflection") return Side::reflection;
    if (*answer == "transmission") return Side::transmission;
    throw Error(ErrorKind::usage, {"--assume side", excerpt(*answer), "reflection or transmission"});
  }
  const auto reflected = static_cast<std::size_t>(
      std::count_if(rows.begin(), rows.end(), [&](const Row& row) { return from_below ? row.theta_deg > 90 : row.theta_deg < 90; }));
  const auto transmitted = static_cast<std::size_t>(
      std::count_if(rows.begin(), rows.end(), [&](const Row& row) { return from_below ? row.theta_deg < 90 : row.theta_deg > 90; }));
  if (reflected > 0 && transmitted > 0)
    throw Error(ErrorKind::input, {file, fmt::format("{} rows of reflection and {} of transmission", reflected, transmitted),
                                   "one of them: --assume side=reflection or side=transmission"});
  return transmitted > 0 ? Side::transmission : Side::reflection;
}

}  // namespace

bool recognises_pab(std::string_view head, std::uintmax_t) {
  return head.starts_with('#') && (head.starts_with("#format: theta phi ") || head.find("\n#format: theta phi ") != std::string_view::npos);
}

Opened open_pab(const std::filesystem::path& path, const ReadOptions& options) {
  const std::string text = read_file(path);
  FaultList faults(path.string());
  FileReader reader(faults);
  reader.read(text);
  faults.raise();
  const Header& header = reader.header();
  const bool from_below = *header.theta_i_deg > 90;
  const auto theta = [&](double degrees_of_file) { return degrees(from_below ? 180 - degrees_of_file : degrees_of_file); };
  const auto phi = [&](double degrees_of_file) { return degrees(from_below ? -degrees_of_file : degrees_of_file); };

  const auto samples = std::make_shared<Dataset>();
  samples->side = side_of_rows(reader.rows(), from_below, options, path.string());
  if (header.values == 3)
    for (const char* name : {"X", "Y", "Z"}) samples->channels.push_back(single_channel(name)[0]);
  else
    samples->channels = single_channel(header.colorimetry.empty() ? "value" : "Y");
  samples->f.resize(header.values);
  samples->masked.nan = reader.nan();
  for (const Row& row : reader.rows()) {
    const GonioAngles angles{theta(*header.theta_i_deg), phi(*header.phi_i_deg), theta(row.theta_deg), phi(row.phi_deg)};
    const bool below = angles.theta_o.degrees() > 90;
    const double factor = factor_to_f(*header.quantity, below ? degrees(180) - angles.theta_o : angles.theta_o);
    if (std::isnan(factor) || (below != (samples->side == Side::transmission) && angles.theta_o.degrees() != 90)) {
      ++samples->masked.below_horizon;
      continue;
    }
    samples->angles.push_back(angles);
    for (std::size_t c = 0; c < header.values; ++c) samples->f[c].push_back(row.values[c] * factor);
  }
  if (samples->size() == 0) throw Error(ErrorKind::input, {path.string(), "no row on the side that was asked for", "at least one"});
  if (!header.sample.empty()) samples->provenance["sample"] = header.sample;
  if (!header.up_phi.empty()) samples->provenance["upphi_deg"] = header.up_phi;

  Opened out = opened_samples("pab", samples);
  out.info.insert(out.info.begin(),
                  {{"holds", *header.quantity == Quantity::f ? "f, cosine not included" : "f cos theta_o (DSF), divided by the cosine"},
                   {"unit", "1/sr"},
                   {"nodes", "at samples, one incidence"}});
  if (from_below) out.info.emplace_back("frame", "light from below: the sample turned over its x axis");
  return out;
}

}  // namespace gonio::tabulated
