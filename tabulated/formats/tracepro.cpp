// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/tracepro.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "brdf/error.hpp"
#include "data-schemas/document.hpp"
#include "data-schemas/write_file.hpp"
#include "tabulated/beta_offset.hpp"
#include "tabulated/fault_list.hpp"
#include "tabulated/formats/csv_text.hpp"
#include "tabulated/lattice_table.hpp"
#include "tabulated/opened_samples.hpp"
#include "tabulated/radial_grid.hpp"
#include "tabulated/values_to_write.hpp"

namespace gonio::tabulated {
namespace {

constexpr std::string_view title = "TracePro Surface Property Data", data_line = "Table_BSDF_Data";
/// Description line of our own files.
constexpr std::string_view across_words = "zero azimuth of scatter across the plane of incidence";
constexpr double nm_per_um = 1000;

struct Row {
  std::size_t line = 0;
  double wavelength_um = 0, incidence_deg = 0, azimuth_deg = 0, beta = 0, scatter_azimuth_deg = 0, brdf = 0, btdf = 0;
};

struct Content {
  std::vector<Row> rows;
  bool across = false;  ///< the description says so
};

Content read_rows(std::string_view bytes, FaultList& faults) {
  Content out;
  CsvLines lines(bytes);
  std::vector<std::string_view> fields;
  bool in_table = false;
  for (auto line = lines.next(); line; line = lines.next()) {
    if (!in_table) {
      if (line->find(across_words) != std::string_view::npos) out.across = true;
      if (line->starts_with(data_line)) in_table = true, lines.next();  // the names of the columns follow
      continue;
    }
    if (line->starts_with("SAVE-DATA") || line->starts_with("Side2_Data")) break;
    if (is_empty_line(*line)) continue;
    split(*line, blanks, fields);
    std::array<double, 8> numbers{};
    bool sound = fields.size() == numbers.size();
    if (!sound) faults.add_at(lines.number(), fmt::format("{} columns", fields.size()), "eight");
    for (std::size_t k = 0; sound && k < fields.size(); ++k) {
      const Number number = parse_number(fields[k]);
      numbers[k] = number.value;
      const bool is_value = k + 2 >= fields.size();
      if (number.fault == nullptr && (is_value || !std::isnan(number.value))) continue;
      faults.add_at(lines.number(), excerpt(fields[k]), is_value ? "a finite number, or nan" : "a finite number");
      sound = false;
    }
    if (!sound) continue;
    const Row row{lines.number(), numbers[1], numbers[2], numbers[3], numbers[4], numbers[5], numbers[6], numbers[7]};
    if (!(row.wavelength_um > 0)) faults.add_at(row.line, fmt::format("wavelength {}", row.wavelength_um), "micrometres above 0");
    if (!(row.incidence_deg >= 0 && row.incidence_deg <= 90))
      faults.add_at(row.line, fmt::format("incidence {}", row.incidence_deg), "0 to 90 degrees");
    if (!(row.beta >= 0 && row.beta <= 2)) faults.add_at(row.line, fmt::format("ScatterBeta {}", row.beta), "0 to 2");
    out.rows.push_back(row);
  }
  if (out.rows.empty() && faults.empty()) faults.add(faults.file(), "no row of Table_BSDF_Data", "at least one");
  return out;
}

Side chosen_side(const std::vector<Row>& rows, const ReadOptions& options, FaultList& faults) {
  const auto is_filled = [](double value) { return !std::isnan(value) && value != 0; };
  const bool brdf = std::any_of(rows.begin(), rows.end(), [&](const Row&row) { return is_filled(row.brdf); }),
             btdf = std::any_of(rows.begin(), rows.end(), [&](const Row&row) { return is_filled(row.btdf); });
  const auto answer = options.assumed("scatter");
  if (answer && *answer != "BRDF" && *answer != "BTDF")
    faults.add(faults.file(), fmt::format("--assume scatter={}", *answer), "BRDF or BTDF");
  if (!answer && brdf && btdf) faults.add(faults.file(), "values of both BRDF and BTDF", "--assume scatter=BRDF or scatter=BTDF");
  return answer ? (*answer == "BTDF" ? Side::transmission : Side::reflection) : btdf && !brdf ? Side::transmission : Side::reflection;
}

/// Where the azimuths of scatter count from, and whether one of them stands for all.
struct Zero {
  bool across = true, rings = false;
};

/// The rows as a table if they hold every combination of their angles once; null if not, or where azimuths count from the sample.
std::shared_ptr<const LatticeTable> table_of(const std::vector<Row>& rows, const Dataset& samples, const Zero& zero) {
  std::array<std::set<double>, 4> axes;
  const auto coordinates = [](const Row& row) { return std::array{row.incidence_deg, row.azimuth_deg, row.beta, row.scatter_azimuth_deg}; };
  for (const Row& row : rows)
    for (std::size_t axis = 0; axis < 4; ++axis) axes[axis].insert(coordinates(row)[axis]);
  Lattice lattice;
  lattice.coordinates = LatticeCoordinates::beta;
  lattice.side = samples.side;
  double nodes = 1;
  for (std::size_t axis = 0; axis < 4; ++axis) {
    lattice.nodes_deg[axis].assign(axes[axis].begin(), axes[axis].end());
    nodes *= static_cast<double>(axes[axis].size());
  }
  // The file's azimuth 0 is across the plane of incidence, the table's is forward.
  for (double& azimuth : lattice.nodes_deg[3]) azimuth -= 90;
  lattice.bilateral = zero.rings;
  const auto within_a_turn = [](const std::vector<double>& azimuths) { return azimuths.back() - azimuths.front() <= 360; };
  if (!zero.across || nodes * static_cast<double>(samples.channels.size()) != static_cast<double>(rows.size()) ||
      !within_a_turn(lattice.nodes_deg[1]) || !within_a_turn(lattice.nodes_deg[3]))
    return nullptr;

  std::map<double, std::size_t> channel_of;
  for (const Row& row : rows) channel_of.emplace(row.wavelength_um, 0);
  std::size_t channels = 0;
  for (auto& [um, place] : channel_of) place = channels++;
  std::vector<std::vector<double>> values(channels, std::vector<double>(lattice.size()));
  std::vector<bool> seen(channels * lattice.size());
  for (const Row& row : rows) {
    std::array<std::size_t, 4> at{};
    for (std::size_t axis = 0; axis < 4; ++axis)
      at[axis] = static_cast<std::size_t>(std::distance(axes[axis].begin(), axes[axis].find(coordinates(row)[axis])));
    const std::size_t channel = channel_of.at(row.wavelength_um), index = lattice.index(at);
    if (seen[channel * lattice.size() + index]) return nullptr;  // then another is missing
    seen[channel * lattice.size() + index] = true;
    values[channel][index] = samples.side == Side::reflection ? row.brdf : row.btdf;
  }
  return std::make_shared<const LatticeTable>(std::move(lattice), samples.channels, std::move(values));
}

Zero zero_of(const Content& content, const ReadOptions& options, FaultList& faults) {
  std::set<double> scatter_azimuths;
  for (const Row& row : content.rows) scatter_azimuths.insert(row.scatter_azimuth_deg);
  Zero out;
  out.rings = scatter_azimuths.size() == 1;
  const std::string zero = options.assumed("zero_azimuth").value_or(out.rings || content.across ? "across" : "");
  if (zero != "across" && zero != "fixed")
    faults.add(faults.file(), zero.empty() ? "azimuths of scatter without their zero" : fmt::format("--assume zero_azimuth={}", zero),
               "--assume zero_azimuth=across (the plane of incidence) or zero_azimuth=fixed (the sample's x axis)");
  out.across = zero == "across";
  return out;
}

Dataset samples_of(const std::vector<Row>& rows, Side side, const Zero& zero, FaultList& faults) {
  std::map<double, std::size_t> channel_of;
  std::set<double> azimuths;
  for (const Row& row : rows) channel_of.emplace(row.wavelength_um, 0), azimuths.insert(row.azimuth_deg);
  Dataset out;
  out.side = side;
  for (auto& [um, place] : channel_of) {
    // Micrometres are written with few digits: 0.351 um is 351 nm, not 350.99999999999994.
    constexpr double digits = 1e9;
    const double nm = std::round(um * nm_per_um * digits) / digits;
    place = out.channels.size();
    out.channels.push_back(single_channel(channel_of.size() == 1 ? "value" : fmt::format("{}nm", nm)).front());
    out.channels.back().wavelength_in_nm = out.channels.back().wavelength_out_nm = nm;
  }
  out.symmetry = {.isotropic = zero.across && azimuths.size() == 1, .bilateral = zero.rings && azimuths.size() == 1};
  out.f.resize(out.channels.size());
  // A table of one azimuth is a table of rings; these azimuths show them to whatever reads samples.
  const std::vector<double> around = even_angles(0, 330, 30);
  std::map<std::array<double, 4>, std::size_t> places;
  for (const Row& row : rows)
    for (const double azimuth : zero.rings&& row.beta > 0 ? around : std::vector<double>{row.scatter_azimuth_deg}) {
      const Angle axis = zero.across ? degrees(row.azimuth_deg + 90) : degrees(0);
      const auto pose = from_beta_offset(degrees(row.incidence_deg), degrees(row.azimuth_deg), row.beta, axis + degrees(azimuth), side);
      const double value = side == Side::reflection ? row.brdf : row.btdf;
      if (!pose || std::isnan(value)) {
        ++(pose ? out.masked.nan : out.masked.below_horizon);
        continue;
      }
      const auto [place, added] =
          places.try_emplace({row.incidence_deg, row.azimuth_deg, row.beta, row.beta == 0 ? 0 : azimuth}, out.angles.size());
      if (added) {
        out.angles.push_back(*pose);
        for (auto& column : out.f) column.push_back(std::numeric_limits<double>::quiet_NaN());
      }
      double& f = out.f[channel_of.at(row.wavelength_um)][place->second];
      if (!std::isnan(f) && f != value) faults.add_at(row.line, "a second value for a direction", "every direction once per wavelength");
      f = value;
    }
  if (faults.empty() && out.size() == 0) faults.add(faults.file(), "no direction above the horizon that has a value", "at least one");
  return out;
}

}  // namespace

bool recognises_tracepro(std::string_view head, std::uintmax_t) { return head.starts_with(title); }

Opened open_tracepro(const std::filesystem::path& path, const ReadOptions& options) {
  FaultList faults(path.string());
  const std::string bytes = read_file(path);
  const Content content = read_rows(bytes, faults);
  faults.raise();
  const Side side = chosen_side(content.rows, options, faults);
  const Zero zero = zero_of(content, options, faults);
  faults.raise();
  Dataset samples = samples_of(content.rows, side, zero, faults);
  faults.raise();
  samples.provenance["source"] = path.filename().string();
  auto table = table_of(content.rows, samples, zero);
  Opened out = opened_samples("tracepro", std::make_shared<const Dataset>(std::move(samples)));
  out.info.insert(out.info.begin(), {{"holds", "f, cosine not included"},
                                     {"unit", "1/sr"},
                                     {"nodes", table ? "a grid of incidence, |beta - beta0| and its azimuth, linear between them"
                                                     : "at samples, by |beta - beta0| and its azimuth"}});
  if (table) out.brdf = std::move(table);
  return out;
}

ExportNotes write_tracepro(const Opened& source, const std::filesystem::path& path, const WriteOptions& options) {
  if (!source.brdf)
    throw Error(ErrorKind::input, {path.string(), fmt::format("a {} that cannot be evaluated", source.format), "a model or a table"});
  if (!source.brdf->symmetry().isotropic) throw Error(ErrorKind::input, {path.string(), "an anisotropic source", "an isotropic one"});
  ExportNotes notes;
  notes.files = {path};
  const Side side = source.side;
  const bool paper = options.size == GridSize::paper, standard = options.size == GridSize::standard;
  const std::vector<double> incidences = incidence_grid(options.size), azimuths = even_angles(0,
                                                                                              paper      ? 330
                                                                                              : standard ? 345
                                                                                                         : 350,
                                                                                              paper      ? 30
                                                                                              : standard ? 15
                                                                                                         : 10);
  std::vector<double> betas{0};
  constexpr double first_beta = 0.002, last_beta = 2;
  const int count = paper ? 19 : standard ? 39 : 79;
  for (int k = 0; k < count; ++k)
    betas.push_back(in_float_digits(first_beta * std::exp(std::log(last_beta / first_beta) * k / (count - 1))));

  std::vector<Row> rows;
  std::vector<GonioAngles> poses;
  std::vector<std::size_t> row_of;
  for (const double incidence : incidences)
    for (const double beta : betas)
      for (const double azimuth : azimuths) {
        rows.push_back({.incidence_deg = incidence, .beta = beta, .scatter_azimuth_deg = azimuth});
        const auto pose = from_beta_offset(degrees(incidence), degrees(0), beta, degrees(90 + azimuth), side);
        if (!pose) {
          ++notes.n_below_horizon;
          continue;
        }
        poses.push_back(*pose), row_of.push_back(rows.size() - 1);
      }
  const ChannelMap map = one_channel(source.brdf->channels());
  const auto values = values_to_write(source, poses, map, options.threads, notes)[0];
  for (std::size_t k = 0; k < row_of.size(); ++k) rows[row_of[k]].brdf = values[k] > 0 ? values[k] : 0;  // NaN is not > 0

  constexpr double usual_um = 0.55, room_temperature_k = 300;
  const double um = map.to[0].wavelength_in_nm ? in_float_digits(*map.to[0].wavelength_in_nm / nm_per_um) : usual_um;
  std::string text = fmt::format(
      "{}\nFile Name\t{}\nTracePro Release: 7 0 0\nDatabase Version: 3 3 0\nData generated at 00:00:00 January 1, "
      "1970\n\nName\tgonio\nCatalog\tgonio\n"
      "Description\t{}\nCoating    1\nScatter    5\nInteraction    0\nPolarization   0\nUser_Data  1\nSolve\tABSORP\n\n"
      "Temperature\tWavelength\tIncAngle\tAziAngle\tAbso_S\tAbso_P\tRefl_S\tRefl_P\tTran_S\tTran_P\tPhaseRefl\tPhaseTran\tBRDF_A\tBRDF_"
      "B\tBRDF_By\t"
      "BRDF_g\tBRDF_gy\tBTDF_A\tBTDF_B\tBTDF_By\tBTDF_g\tBTDF_gy\n",
      title, path.filename().string(), across_words);
  for (const double incidence : incidences) {
    text += fmt::format("{}\t{}\t{}\t0", room_temperature_k, um, incidence);
    for (int column = 4; column < 22; ++column) text += "\t0";
    text += '\n';
  }
  text += fmt::format("{}\nTemperature\tWavelength\tIncAngle\tAziAngle\tScatterBeta\tScatterAzimuth\tBRDF\tBTDF\n", data_line);
  for (const Row& row : rows) {
    text += fmt::format("{}\t{}\t{}\t0\t{}\t{}\t", room_temperature_k, um, row.incidence_deg, row.beta, row.scatter_azimuth_deg);
    if (side == Side::transmission) text += "0\t";
    append_number(text, row.brdf);
    text += side == Side::transmission ? "\n" : "\t0\n";
  }
  notes.facts.emplace_back(
      "grid", fmt::format("{} incidences x {} values of |beta - beta0| x {} azimuths", incidences.size(), betas.size(), azimuths.size()));
  notes.facts.emplace_back("azimuth", "0 across the plane of incidence: leave `Use fixed axis for zero-azimuth' unchecked");
  notes.lost.emplace_back("untested: not tried with TracePro itself");
  if (!map.to[0].wavelength_in_nm) notes.lost.emplace_back("the wavelength is unknown: 0.55 um is written");
  if (notes.n_unknown + notes.n_negative + notes.n_below_horizon > 0)
    notes.lost.emplace_back("unknown and negative values and nodes beyond the horizon are 0");
  write_file_atomically(path, text);
  return notes;
}

}  // namespace gonio::tabulated
