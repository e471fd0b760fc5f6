// SPDX-License-Identifier: BSD-3-Clause
#include "tools/measured_table.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "brdf/analytic_brdf.hpp"
#include "fitting/fit.hpp"
#include "tabulated/direction_table.hpp"
#include "tabulated/guided_table.hpp"
#include "tabulated/in_parallel.hpp"
#include "tools/output.hpp"

namespace gonio::tools {
namespace {

/// Tried by --guide auto: a diffuse one, lobes about the mirror direction and about the half vector, a long-tailed lobe, and two lobes.
constexpr std::array auto_models{"lambert", "phong", "blinn-phong", "ggx-separable-fresnel", "blinn-phong+ggx-separable"};
/// Values of many decades want another metric than those of one.
constexpr std::array auto_metrics{fitting::Metric::linear, fitting::Metric::cbrt};
/// Of more samples than this, guides are fitted to this many and compared by what they predict of this many: a guide need not be better
/// than its family, and to be told from another takes fewer predictions still.
constexpr std::size_t fitted_samples = std::size_t{1} << 12, compared_samples = std::size_t{1} << 11;
/// Pairs at which a source without samples is compared with itself after symmetry was imposed.
constexpr std::size_t compared_pairs = 4000;

/// Pairs at which a table of samples is asked how much of it is extrapolated, and the part from which on it is no table of the samples.
constexpr std::size_t coverage_pairs = 2048;
constexpr double mostly = 0.5;
/// An incidence this near to the normal has no azimuth [deg].
constexpr double at_normal_deg = 0.5;

struct Candidate {
  TriedGuide tried;
  std::shared_ptr<const Brdf> brdf;  ///< null: no guide
};

double worst(const TriedGuide& guide) {
  if (std::isnan(guide.alone)) return std::numeric_limits<double>::infinity();
  return std::isnan(guide.incidence) ? guide.alone : 0.5 * (guide.alone + guide.incidence);
}

std::string parameters_text(const fitting::FitResult& fit) {
  std::string out;
  const ModelInfo& model = model_info(fit.model);
  for (std::size_t p = 0; p < model.parameters.size(); ++p) {
    out += fmt::format("{}{} = ", out.empty() ? "" : ", ", model.parameters[p].name);
    for (std::size_t c = 0; c < fit.values.size() && c < 3; ++c) out += fmt::format("{}{:.4g}", c > 0 ? " " : "", fit.values[c][p]);
    if (fit.values.size() > 3) out += " ...";
  }
  return out;
}

std::optional<Candidate> fitted(const Observations& observations, const std::string& model, fitting::Metric metric) {
  fitting::FitOptions options;
  options.model = model;
  options.metric = metric;
  options.only_values = true;
  options.ignore_apertures = true;  // the guide stands for the readings, which are means over the apertures
  options.most_samples = fitted_samples;
  options.threads = 1;
  const fitting::FitResult fit = fitting::fit(observations, options);
  if (fit.status != fitting::Status::converged && fit.status != fitting::Status::not_converged) return std::nullopt;
  if (fit.values.empty()) return std::nullopt;
  return Candidate{{fmt::format("{} ({})", model, fitting::name(metric)), parameters_text(fit), 0, 0},
                   std::make_shared<const AnalyticBrdf>(model, fit.channels, fit.values)};
}

std::vector<Candidate> candidates(const std::string& guide, const Observations& observations, int threads) {
  std::vector<Candidate> out;
  if (guide == "none") return {{{"none", "", 0, 0}, nullptr}};
  if (guide != "auto" && !is_model(guide)) {
    const tabulated::Opened opened = tabulated::open_brdf(guide);
    if (!opened.brdf)
      throw Error(ErrorKind::input, {"--guide " + guide, opened.format + " that cannot be evaluated", "a model or a table"});
    return {{{guide, "", 0, 0}, opened.brdf}};
  }
  std::vector<std::pair<std::string, fitting::Metric>> tries;
  for (const char* model : auto_models)
    for (const fitting::Metric metric : auto_metrics)
      if (guide == "auto") tries.emplace_back(model, metric);
  if (guide != "auto")
    for (const fitting::Metric metric : auto_metrics) tries.emplace_back(guide, metric);
  std::vector<std::optional<Candidate>> found(tries.size());
  tabulated::in_parallel(tries.size(), threads, [&](std::size_t k) { found[k] = fitted(observations, tries[k].first, tries[k].second); });
  for (auto& one : found)
    if (one) out.push_back(std::move(*one));
  if (out.empty() && guide != "auto")
    throw Error(ErrorKind::input, {"--guide " + guide, "a model that cannot be fitted to the samples", "another model, or auto"});
  if (guide == "auto") out.push_back({{"none", "", 0, 0}, nullptr});
  return out;
}

/// The samples as the table takes them: isotropy as a flag, the shadow of the detector without values.
std::shared_ptr<const Dataset> prepared(const Dataset& samples, const Symmetry& imposed, double mask_retro_deg, std::size_t& n_masked) {
  auto out = std::make_shared<Dataset>(samples);
  out->symmetry.isotropic = out->symmetry.isotropic || imposed.isotropic;
  if (mask_retro_deg > 0) {
    const double nearest = degrees(mask_retro_deg).cos();
    for (std::size_t k = 0; k < out->size(); ++k)
      if (dot(out->angles[k].wi(), out->angles[k].wo()) > nearest) {
        ++n_masked;
        for (auto& channel : out->f) channel[k] = std::numeric_limits<double>::quiet_NaN();
      }
  }
  return out;
}

/// Number k of a Kronecker sequence over the unit hypercube, by powers of the root of x^5 = x + 1.
double kronecker(std::size_t k, double step) { return std::fmod(static_cast<double>(k) * step + 0.5, 1.0); }
constexpr std::array kronecker_steps{0.8566748838545029, 0.733891856627126, 0.6287067210378087, 0.5385972572236101};

double part_beyond(const UncertainBrdf& table, Side side) {
  std::vector<Direction> wi, wo;
  for (std::size_t k = 0; k < coverage_pairs; ++k) {
    const auto direction = [&](std::size_t axis, double sign) {  // uniform in projected solid angle
      const double r = std::sqrt(kronecker(k, kronecker_steps[axis])), phi = 2 * std::numbers::pi * kronecker(k, kronecker_steps[axis + 1]);
      return Direction::trusted(r * std::cos(phi), r * std::sin(phi), sign * std::sqrt(1 - r * r));
    };
    wi.push_back(direction(0, 1)), wo.push_back(direction(2, side == Side::transmission ? -1 : 1));
  }
  std::vector<double> f(wi.size() * table.channels().size()), u(f.size());
  std::vector<Coverage> coverage(wi.size());
  table.eval_with_uncertainty(wi, wo, f, u, coverage);
  const auto beyond = std::count_if(coverage.begin(), coverage.end(), [](Coverage how) { return how >= Coverage::extrapolated; });
  return static_cast<double>(beyond) / coverage_pairs;
}

/// The azimuth of the light [deg] if all samples have the same; nothing if none has one.
std::optional<double> one_azimuth(const Dataset& samples) {
  std::optional<double> out;
  for (const GonioAngles& pair : samples.angles) {
    if (std::fabs(pair.theta_i.degrees()) < at_normal_deg) continue;
    const Direction wi = pair.wi();
    if (!out) out = wi.phi().degrees();
    const Direction first = Direction::spherical(wi.theta(), degrees(*out));
    constexpr double same = 1e-6;
    if (std::hypot(wi.x() - first.x(), wi.y() - first.y()) > same) return std::nullopt;
  }
  return out;
}

/// The pairs at which what symmetry changes is told: the samples, or pairs spread over both hemispheres.
std::pair<std::vector<GonioAngles>, std::vector<double>> compared(const tabulated::Opened& source) {
  std::pair<std::vector<GonioAngles>, std::vector<double>> out;
  auto& [pairs, f] = out;
  const std::size_t channels = source.brdf->channels().size();
  if (source.dataset) {
    pairs = source.dataset->angles;
    for (std::size_t k = 0; k < pairs.size(); ++k)
      for (std::size_t c = 0; c < channels; ++c) f.push_back(source.dataset->f[c][k]);
    return out;
  }
  for (std::size_t k = 0; k < compared_pairs; ++k) {
    const auto theta = [](double u) { return degrees(radians(std::acos(1 - 0.8 * u)).degrees()); };  // to 78°
    const auto part = [&](std::size_t axis) { return kronecker(k, kronecker_steps[axis]); };
    pairs.push_back({theta(part(0)), degrees(360 * part(1)), theta(part(2)), degrees(360 * part(3))});
  }
  std::vector<Direction> wi, wo;
  for (const GonioAngles& pair : pairs) wi.push_back(pair.wi()), wo.push_back(pair.wo());
  f.resize(pairs.size() * channels);
  source.brdf->eval(wi, wo, f);
  return out;
}

}  // namespace

void TableFlags::add_to(CLI::App& app) {
  add_interpolation_to(app);
  app.add_flag("--resample", resample,
               "Write the table made of the samples, on the grid of --size, where the format could keep the samples");
}

void TableFlags::add_interpolation_to(CLI::App& app) {
  app.add_option("--guide", guide,
                 "Samples are interpolated as their ratio to: auto (the best of a few fits), none, a model, or a BRDF file");
  app.add_option(
         "--extrapolate", extrapolate,
         "Beyond the samples and in masked regions: model (the guide, bounded by energy) or no. Without this flag model, but no file is "
         "written of which most would be extrapolated")
      ->check(CLI::IsMember({"model", "no"}));
  app.add_option("--impose", impose, "Average over what is no property of the data: reciprocity, isotropy, bilateral (comma separated)");
  app.add_option("--mask-retro", mask_retro_deg, "Samples closer than this to the way back to the light lie in the detector's shadow [deg]")
      ->check(CLI::Range(0.0, 45.0));
}

bool is_scattered(const tabulated::Opened& source) {
  // The nodes of a table are samples too, but the table knows itself what lies between them.
  return source.dataset && dynamic_cast<const tabulated::DirectionTable*>(source.brdf.get()) != nullptr;
}

Symmetry TableFlags::imposed() const {
  Symmetry out;
  for (const std::string& name : comma_separated(impose)) {
    if (name == "reciprocity")
      out.reciprocal = true;
    else if (name == "isotropy")
      out.isotropic = true;
    else if (name == "bilateral")
      out.bilateral = true;
    else
      throw Error(ErrorKind::usage, {"--impose", "'" + name + "'", "reciprocity, isotropy or bilateral, or some of them"});
  }
  return out;
}

tabulated::Opened measured_table(const tabulated::Opened& source, const TableFlags& flags, int threads, TableReport& report) {
  const Symmetry imposed = flags.imposed();
  tabulated::Opened out = source;
  std::pair<std::vector<GonioAngles>, std::vector<double>> before;
  const bool scattered = is_scattered(source);
  if (imposed != Symmetry{} && source.brdf && !scattered) before = compared(source);
  if (!scattered && (flags.resample || imposed != Symmetry{})) out.dataset.reset();
  if (scattered) {
    const auto samples = prepared(*source.dataset, imposed, flags.mask_retro_deg, report.n_masked_retro);
    const tabulated::GuidedTableOptions options{.extrapolate = flags.extrapolate != "no", .threads = threads};
    auto tried = candidates(flags.guide, *observe(samples), threads);
    tabulated::GuidedSamples guided = tabulated::guided_samples(*samples, nullptr);
    std::size_t best = 0;
    std::vector<tabulated::InterpolationError> errors;
    for (Candidate& one : tried) {
      guided = tabulated::with_guide(std::move(guided), one.brdf.get());
      errors.push_back(tabulated::estimate_interpolation_error(guided, threads, compared_samples));
      one.tried.alone = errors.back().mean_alone, one.tried.incidence = errors.back().mean_incidence;
      report.guides.push_back(one.tried);
      if (worst(one.tried) < worst(tried[best].tried)) best = errors.size() - 1;
    }
    guided = tabulated::with_guide(std::move(guided), tried[best].brdf.get());
    if (guided.means.size() > compared_samples) errors[best] = tabulated::estimate_interpolation_error(guided, threads);
    const auto table = std::make_shared<const tabulated::GuidedTable>(samples, tried[best].brdf, std::move(guided), errors[best], options);
    std::rotate(report.guides.begin(), report.guides.begin() + static_cast<std::ptrdiff_t>(best),
                report.guides.begin() + static_cast<std::ptrdiff_t>(best) + 1);
    report.guides.front().alone = table->error().mean_alone, report.guides.front().incidence = table->error().mean_incidence;
    out.dataset = samples;
    before = compared(out);
    if (!samples->symmetry.isotropic) report.one_azimuth_deg = one_azimuth(*samples);
    report.n_samples = samples->size() - report.n_masked_retro;
    report.n_left_out = table->error().n_left_out;
    report.extrapolated = options.extrapolate;
    report.noise_estimated = std::any_of(table->error().noise.begin(), table->error().noise.end(), [](double noise) { return noise != 0; });
    out.brdf = out.uncertain = table;
    if (report.n_masked_retro == 0) out.dataset = source.dataset;
    if (flags.resample || imposed != Symmetry{}) out.dataset.reset();
  }
  if (imposed == Symmetry{} || !out.brdf) {
    if (scattered) report.beyond = part_beyond(*out.uncertain, out.side);
    return out;
  }
  const auto table = std::make_shared<const tabulated::ImposedBrdf>(out.brdf, out.uncertain, imposed);
  const auto tell = [&](const char* name, const Symmetry& one) {
    report.imposed.emplace_back(
        name, tabulated::symmetry_change(before.first, before.second, tabulated::ImposedBrdf(out.brdf, out.uncertain, one)));
  };
  if (imposed.isotropic) tell("isotropy", {true, false, false});
  if (imposed.bilateral) tell("bilateral", {false, true, false});
  if (imposed.reciprocal) tell("reciprocity", {false, false, true});
  out.brdf = out.uncertain = table;
  out.observations.reset();
  if (scattered) report.beyond = part_beyond(*out.uncertain, out.side);
  return out;
}

std::string coverage_warning(const TableReport& report) {
  if (!(report.beyond > mostly)) return {};
  std::string out = fmt::format("{:.0f} % of the pairs of directions lie beyond the samples", 100 * report.beyond);
  if (report.one_azimuth_deg)
    out += fmt::format(
        ": their light came from one azimuth ({:g} deg), and nothing says that the sample is isotropic (if it is: --impose isotropy)",
        *report.one_azimuth_deg);
  return out;
}

void require_covered(const std::string& where, const TableFlags& flags, const TableReport& report) {
  const std::string found = coverage_warning(report);
  if (found.empty() || !flags.extrapolate.empty()) return;
  throw Error(
      ErrorKind::input,
      {where, found,
       fmt::format("--impose {} if the sample has that symmetry, or --extrapolate model to write guesses, or no to leave them unknown",
                   report.one_azimuth_deg ? "isotropy (and bilateral if one half of the azimuths was measured)"
                                          : "bilateral (if one half of the azimuths was measured)")});
}

std::string interpolation_line(const TableReport& report) {
  if (report.guides.empty()) return {};
  const TriedGuide& guide = report.guides.front();
  return fmt::format("interpolated as the ratio to {} (samples left out are predicted to {:.2g} %)", guide.name, 100 * guide.alone);
}

Json table_document(const TableReport& report) {
  const auto number = [](double value) { return std::isfinite(value) ? Json(value) : Json(); };
  Json guides = Json::array(), imposed = Json::array();
  for (const TriedGuide& guide : report.guides)
    guides.push_back(Json::object({{"name", guide.name},
                                   {"parameters", guide.parameters},
                                   {"error_alone", number(guide.alone)},
                                   {"error_incidence", number(guide.incidence)}}));
  for (const auto& [name, change] : report.imposed) {
    const GonioAngles& at = change.largest_at;
    Json place = Json::array();
    for (const Angle& angle : {at.theta_i, at.phi_i, at.theta_o, at.phi_o}) place.push_back(angle.degrees());
    imposed.push_back(Json::object({{"symmetry", name},
                                    {"n", static_cast<std::int64_t>(change.n)},
                                    {"n_changed", static_cast<std::int64_t>(change.n_changed)},
                                    {"n_left_out", static_cast<std::int64_t>(change.n_left_out)},
                                    {"mean", change.mean},
                                    {"p95", change.p95},
                                    {"largest", change.largest},
                                    {"largest_at_deg", std::move(place)}}));
  }
  return Json::object({{"guides", std::move(guides)},
                       {"n_samples", static_cast<std::int64_t>(report.n_samples)},
                       {"n_masked_retro", static_cast<std::int64_t>(report.n_masked_retro)},
                       {"n_left_out", static_cast<std::int64_t>(report.n_left_out)},
                       {"extrapolate", report.extrapolated ? "model" : "no"},
                       {"part_beyond", report.beyond},
                       {"one_azimuth_deg", report.one_azimuth_deg ? Json(*report.one_azimuth_deg) : Json()},
                       {"noise_estimated", report.noise_estimated},
                       {"imposed", std::move(imposed)}});
}

std::vector<std::string> table_lines(const TableReport& report) {
  std::vector<std::string> out;
  if (!report.guides.empty()) {
    const TriedGuide& guide = report.guides.front();
    out.push_back(fmt::format("  {:<22} {}{}", "guide", guide.name, guide.parameters.empty() ? "" : ": " + guide.parameters));
    out.push_back(fmt::format("  {:<22} {:.2f} % left out alone{}, mean relative error of {} samples predicted from the others",
                              "interpolation", 100 * guide.alone,
                              std::isnan(guide.incidence) ? "" : fmt::format(", {:.2f} % with their incidence", 100 * guide.incidence),
                              report.n_samples));
    for (std::size_t k = 1; k < report.guides.size(); ++k)
      out.push_back(fmt::format("  {:<22} {} ({:.2f} %, {:.2f} %)", k == 1 ? "guides not taken" : "", report.guides[k].name,
                                100 * report.guides[k].alone, 100 * report.guides[k].incidence));
    if (report.n_masked_retro > 0)
      out.push_back(fmt::format("  {:<22} {} samples in the detector's shadow", "masked", report.n_masked_retro));
    if (report.noise_estimated)
      out.push_back(fmt::format("  {:<22} estimated from the spread of the samples, which state none", "uncertainty"));
    out.push_back(fmt::format("  {:<22} {:.0f} % of the pairs of directions: {}", "beyond the samples", 100 * report.beyond,
                              report.extrapolated ? "by the guide, bounded by energy" : "nothing"));
    if (report.one_azimuth_deg)
      out.push_back(fmt::format("  {:<22} one azimuth of the light, {:g} deg, and no stated isotropy", "samples", *report.one_azimuth_deg));
  }
  for (const auto& [name, change] : report.imposed)
    out.push_back(fmt::format(
        "  {:<22} changes {} of {} values: |ln ratio| mean {:.4f}, 95th percentile {:.4f}, largest {:.4f} at {:g} {:g} {:g} {:g} deg",
        "imposed " + name, change.n_changed, change.n, change.mean, change.p95, change.largest, change.largest_at.theta_i.degrees(),
        change.largest_at.phi_i.degrees(), change.largest_at.theta_o.degrees(), change.largest_at.phi_o.degrees()));
  return out;
}

}  // namespace gonio::tools
