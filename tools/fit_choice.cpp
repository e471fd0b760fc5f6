// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fit_choice.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>

#include <fmt/format.h>

#include "brdf/analytic_brdf.hpp"
#include "fitting/joint_observations.hpp"
#include "tools/fit_job.hpp"
#include "tools/progress_bar.hpp"
#include "tools/stop_signal.hpp"

namespace gonio::tools {
namespace {

using fitting::Candidate;
using fitting::every_metric;

/// `linear_cos`: a metric as a member of a document.
std::string member_name(fitting::Metric metric) {
  std::string out = name(metric);
  std::replace(out.begin(), out.end(), '-', '_');
  return out;
}

/// A global search over more parameters takes minutes a fit.
constexpr std::size_t most_nonlinear_of_all = 3;

/// Of the best models; the document has all of them.
constexpr std::size_t most_hints = 3;

Json count(std::size_t n) { return static_cast<std::int64_t>(n); }

Json text_or_null(const std::string& text) { return text.empty() ? Json() : Json(text); }

const char* name(fitting::Folds::Over over) {
  switch (over) {
    case fitting::Folds::Over::incidences: return "incidences";
    case fitting::Folds::Over::incidence_groups: return "incidence_groups";
    case fitting::Folds::Over::incidence_bins: return "incidence_bins";
    case fitting::Folds::Over::outgoing_bins: return "outgoing_bins";
    case fitting::Folds::Over::nothing: break;
  }
  return "nothing";
}

const char* name(fitting::NoiseLevel::Source source) {
  switch (source) {
    case fitting::NoiseLevel::Source::stated: return "stated";
    case fitting::NoiseLevel::Source::repeats: return "repeats";
    case fitting::NoiseLevel::Source::unknown: break;
  }
  return "unknown";
}

Json candidate_document(const Candidate& candidate) {
  Json errors = Json::object(), ranks = Json::object();
  for (std::size_t m = 0; m < every_metric.size(); ++m) {
    errors.set(member_name(every_metric[m]), or_null(candidate.cross_validated[m]));
    ranks.set(member_name(every_metric[m]), candidate.rank[m] ? count(*candidate.rank[m]) : Json());
  }
  return Json::object({{"model", candidate.model},
                       {"ranked", candidate.ranked},
                       {"adequate", candidate.adequate},
                       {"reason", text_or_null(candidate.reason)},
                       {"hint", text_or_null(candidate.hint)},
                       {"status", fitting::name(candidate.fit.status)},
                       {"free_parameters", count(candidate.free_parameters)},
                       {"score", or_null(candidate.score)},
                       {"relative_error", or_null(candidate.relative_error)},
                       {"aicc", or_null(candidate.aicc)},
                       {"bic", or_null(candidate.bic)},
                       {"cross_validated", errors},
                       {"rank", ranks},
                       {"parameters", parameters_document(candidate.fit)},
                       {"errors", errors_document(candidate.fit.errors)}});
}

/// A number of the table, NaN where there is none.
std::string cell(double value, const char* format) { return std::isnan(value) ? "-" : fmt::format(fmt::runtime(format), value); }

/// Criteria as differences to the least: only those mean anything.
double above_least(const fitting::ModelChoice& choice, std::optional<double> Candidate::*criterion, const Candidate& candidate) {
  double least = std::numeric_limits<double>::infinity();
  for (const Candidate& other : choice.candidates) least = std::min(least, (other.*criterion).value_or(least));
  return (candidate.*criterion).value_or(std::nan("")) - least;
}

}  // namespace

void ChoiceFlags::add_to(CLI::App& app) {
  app.add_option("--folds", folds, "Several models: parts the incidences are divided into for cross-validation")->check(CLI::Range(2, 254));
  app.add_option("--margin", margin, "Several models: relative error of an adequate one, beyond the noise")->check(CLI::Range(1e-6, 1e3));
}

std::vector<std::string> several_models(const std::string& text) {
  std::vector<std::string> out;
  const auto add = [&](const std::string& model) {
    if (std::find(out.begin(), out.end(), model) == out.end()) out.push_back(model);
  };
  for (const std::string& part : comma_separated(text))
    if (part == "all") {
      for (const ModelInfo& info : model_infos())
        if (info.nonlinear_count() <= most_nonlinear_of_all) add(info.name);
    } else {
      add(model_info(part).name);
    }
  return out.size() > 1 || text.find(',') != text.npos ? out : std::vector<std::string>{};
}

Json choice_document(const fitting::ModelChoice& choice, const MaskedCounts& masked, Json context, Json options) {
  Json candidates = Json::array();
  for (const Candidate& candidate : choice.candidates) candidates.push_back(candidate_document(candidate));
  const bool noise_known = choice.noise.source != fitting::NoiseLevel::Source::unknown;
  return Json::object({{"context", std::move(context)},
                       {"options", std::move(options)},
                       {"verdict", choice.verdict},
                       {"adequate", choice.any_adequate},
                       {"single_lobe_adequate", choice.single_lobe_adequate},
                       {"best", or_null(choice.best)},
                       {"simplest", or_null(choice.simplest)},
                       {"margin", choice.margin},
                       {"confidence", choice.candidates.front().fit.confidence},
                       {"cross_validation", Json::object({{"over", name(choice.folds.over)},
                                                          {"folds", count(choice.folds.count)},
                                                          {"places", count(choice.folds.places)},
                                                          {"n_samples", count(choice.n_samples)},
                                                          {"detail", fitting::description(choice.folds)}})},
                       {"noise", Json::object({{"source", name(choice.noise.source)},
                                               {"linear_cos", noise_known ? Json(choice.noise.linear_cos) : Json()},
                                               {"cbrt", noise_known ? Json(choice.noise.cbrt) : Json()}})},
                       {"candidates", candidates},
                       {"n_masked", masked_document(masked)},
                       {"choice_s", choice.choice_s}});
}

std::vector<std::string> choice_lines(const fitting::ModelChoice& choice) {
  std::size_t width = 8;
  for (const Candidate& candidate : choice.candidates) width = std::max(width, candidate.model.size());
  std::vector<std::string> lines;
  lines.push_back("cross-validation: " + fitting::description(choice.folds));
  lines.push_back(fmt::format("{:<{}} {:>10} {:>10} {:>10} {:>7} {:>9} {:>11} {:>11} {:>3}", "model", width, "linear-cos", "log1p", "cbrt",
                              "score", "relative", "AICc", "BIC", "k"));
  for (const Candidate& c : choice.candidates) {
    if (!c.ranked) {
      lines.push_back(fmt::format("{:<{}} not ranked: {}", c.model, width, c.reason));
      continue;
    }
    const auto error = [&](fitting::Metric metric) {
      return cell(c.cross_validated[static_cast<std::size_t>(metric)].value_or(std::nan("")), "{:.4g}");
    };
    const double percent = 100 * c.relative_error.value_or(std::nan(""));
    lines.push_back(fmt::format("{:<{}} {:>10} {:>10} {:>10} {:>7} {:>9} {:>11} {:>11} {:>3}{}{}", c.model, width,
                                error(fitting::Metric::linear_cos), error(fitting::Metric::log1p), error(fitting::Metric::cbrt),
                                cell(c.score.value_or(std::nan("")), "{:.3f}"), cell(percent, "{:.3g} %"),
                                cell(above_least(choice, &Candidate::aicc, c), "{:+.1f}"),
                                cell(above_least(choice, &Candidate::bic, c), "{:+.1f}"), c.free_parameters, c.adequate ? "  adequate" : "",
                                c.reason.empty() ? "" : "  (" + c.reason + ")"));
  }
  lines.push_back(
      "(rms errors of samples left out; score: geometric mean of the three, each over the least; AICc, BIC: above the least; k: free "
      "parameters)");
  std::size_t hints = 0;
  for (const Candidate& c : choice.candidates)
    if (!c.hint.empty() && hints++ < most_hints) lines.push_back(c.model + ": " + c.hint);
  lines.push_back(choice.verdict);
  if (choice.simplest && choice.simplest != choice.best)
    lines.push_back(*choice.simplest + " is as good as " + *choice.best + " to one standard error, with fewer parameters");
  return lines;
}

int fit_choice(const std::vector<std::string>& files, const std::vector<std::string>& models, const FitRequest& request,
               const ChoiceFlags& flags, int jobs, const std::string& out, Console& console) {
  const std::vector<HashedInput> hashes = hash_inputs(files, request.read);
  const FitInput input = read_inputs(files, request.read, console);
  fitting::ChoiceOptions options;
  options.models = models;
  options.fit = request.fit;
  options.max_folds = flags.folds;
  options.margin = flags.margin;
  options.jobs = jobs > 0 ? jobs : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  options.stop = &stop_on_signals();
  fitting::ModelChoice choice;
  {
    ProgressBar bar(console, "fit", models.size());
    options.fitted = [&](std::size_t total) {
      bar.expect(total);
      bar.advance();
    };
    choice = fitting::choose_model(fitting::join(input.parts), options);
  }
  Json all_options = request.options;
  all_options.set("folds", count(flags.folds));
  all_options.set("margin", flags.margin);
  if (console.json || !out.empty()) {
    const Json document = choice_document(choice, input.masked, context(hashes, std::nullopt, input.simulated), std::move(all_options));
    if (!out.empty()) write_file_atomically(out, document.dump(2) + "\n");
    if (console.json) console.print_json(document);
  }
  if (!console.json)
    for (const std::string& line : choice_lines(choice)) console.print(line);
  return choice.best ? 0 : 1;
}

}  // namespace gonio::tools
