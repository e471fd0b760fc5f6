// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fit_flags.hpp"

#include <CLI/CLI.hpp>
#include <optional>

#include "brdf/analytic_brdf.hpp"

namespace gonio::tools {
namespace {

constexpr const char* metric_list = "linear, linear-cos, log, log1p or cbrt";
constexpr const char* weights_list = "auto, none, uncertainty, variance or solid_angle";
constexpr const char* nuisance_list = "tilt, azimuth, components, or several of them separated by commas";
constexpr const char* robust_list = "auto, none, huber or cauchy";

/// The value that `named` finds for a flag's text; nothing if the flag was not given. Error(usage) with the `known` ones.
template <class T>
std::optional<T> choice_of(const char* flag, const std::string& text, std::optional<T> (*named)(std::string_view), const char* known) {
  if (text.empty()) return std::nullopt;
  const std::optional<T> found = named(text);
  if (!found) throw Error(ErrorKind::usage, {flag, "'" + text + "'", known});
  return found;
}

/// NAME=LOW,HIGH.
std::pair<std::string, fitting::Bounds> bounds_from(const std::string& text) {
  const auto [name, ends] = name_value(text, "--bound");
  const auto comma = ends.find(',');
  if (comma == ends.npos) throw Error(ErrorKind::usage, {"--bound", "'" + text + "'", "NAME=LOW,HIGH"});
  return {name, {number_from(ends.substr(0, comma), "--bound " + name), number_from(ends.substr(comma + 1), "--bound " + name)}};
}

Json options_document(const FitFlags& flags, const fitting::FitOptions& fit, const std::vector<std::string>& models) {
  std::string names;
  for (const std::string& model : models) names += (names.empty() ? "" : ",") + model;
  Json out = Json::object({{"model", names}});
  const ReadFlags& read = flags.read;
  if (fit.metric) out.set("metric", name(*fit.metric));
  if (!fit.fixed.empty()) {
    Json fixed = Json::object();
    for (const auto& [parameter, value] : fit.fixed) fixed.set(parameter, value);
    out.set("fix", fixed);
  }
  if (!fit.bounds.empty()) {
    Json bounds = Json::object();
    for (const auto& [parameter, ends] : fit.bounds) bounds.set(parameter, Json(Json::Array{ends.low, ends.high}));
    out.set("bound", bounds);
  }
  if (fit.per_channel) out.set("per-channel", true);
  if (fit.nuisance.any()) out.set("nuisance", name(fit.nuisance));
  if (fit.ignore_apertures) out.set("ignore-apertures", true);
  if (fit.confidence != fitting::FitOptions().confidence) out.set("confidence", fit.confidence);
  if (fit.most_samples != fitting::FitOptions().most_samples) out.set("max-samples", static_cast<std::int64_t>(fit.most_samples));
  for (const auto& [flag, value] : {std::pair{"weights", flags.weights},
                                    {"robust", flags.robust},
                                    {"format", read.format},
                                    {"columns", read.columns},
                                    {"quantity", read.quantity},
                                    {"blank", read.blank},
                                    {"in-plane", read.in_plane},
                                    {"missing", read.missing},
                                    {"merl-nodes", read.merl_nodes}})
    if (!value.empty()) out.set(flag, value);
  if (!read.set.empty()) {
    Json set = Json::array();
    for (const std::string& text : read.set) set.push_back(text);
    out.set("set", set);
  }
  return out;
}

}  // namespace

void FitFlags::add_to(CLI::App& app) {
  std::string models;
  for (const ModelInfo& info : model_infos()) models += (models.empty() ? "" : ", ") + std::string(info.name);
  app.add_option("--model", fit.model, "One of " + models + ", or a sum of them, a+b; a list separated by commas, or all, to rank them")
      ->required();
  app.add_option("--metric", metric, metric_list);
  app.add_option("--weights", weights, std::string("What a sample counts: ") + weights_list);
  app.add_option("--robust", robust, std::string("Against wrong readings: ") + robust_list);
  app.add_option("--fix", fixed, "NAME=VALUE: hold a parameter")->take_all();
  app.add_option("--bound", bounds, "NAME=LOW,HIGH: search a parameter there only")->take_all();
  app.add_option("--nuisance", nuisance,
                 std::string("Estimate with the model what the sample's mount and the instrument share: ") + nuisance_list);
  app.add_flag("--ignore-apertures", fit.ignore_apertures,
               "Compare with the model at the nominal directions whatever apertures are stated");
  app.add_option("--confidence", fit.confidence, "Of the intervals (default 0.95)");
  app.add_option("--max-samples", fit.most_samples,
                 "Of more samples that can be neither summed nor binned, fit one of every few (default 65536; 0: all)");
  app.add_flag("--per-channel", fit.per_channel, "Nonlinear parameters per channel");
  read.add_to(app);
}

FitRequest FitFlags::request() const {
  model_info(fit.model);
  return request({fit.model});
}

FitRequest FitFlags::request(const std::vector<std::string>& models) const {
  FitRequest out;
  out.fit = fit;
  out.fit.metric = choice_of("--metric", metric, fitting::metric_named, metric_list);
  out.fit.weights = choice_of("--weights", weights, fitting::weights_named, weights_list).value_or(out.fit.weights);
  out.fit.robust = choice_of("--robust", robust, fitting::robust_named, robust_list);
  out.fit.nuisance = choice_of("--nuisance", nuisance, fitting::nuisance_named, nuisance_list).value_or(out.fit.nuisance);
  for (const std::string& text : fixed) {
    const auto [name, value] = name_value(text, "--fix");
    out.fit.fixed[name] = number_from(value, "--fix " + name);
  }
  for (const std::string& text : bounds) {
    const auto [name, ends] = bounds_from(text);
    out.fit.bounds.insert_or_assign(name, ends);
  }
  out.read = read.options();
  out.options = options_document(*this, out.fit, models);
  return out;
}

}  // namespace gonio::tools
