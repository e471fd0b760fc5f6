// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fit_flags.hpp"

#include <CLI/CLI.hpp>

#include "brdf/analytic_brdf.hpp"

namespace gonio::tools {
namespace {

std::string metric_list() { return "linear, linear-cos, log, log1p or cbrt"; }

Json options_document(const fitting::FitOptions& fit, const ReadFlags& read) {
  Json out = Json::object({{"model", fit.model}, {"metric", name(fit.metric.value_or(fitting::Metric::linear))}});
  if (!fit.fixed.empty()) {
    Json fixed = Json::object();
    for (const auto& [parameter, value] : fit.fixed) fixed.set(parameter, value);
    out.set("fix", fixed);
  }
  if (fit.per_channel) out.set("per-channel", true);
  for (const auto& [flag, value] : {std::pair{"format", read.format},
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
  app.add_option("--metric", metric, metric_list());
  app.add_option("--fix", fixed, "NAME=VALUE: hold a parameter")->take_all();
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
  if (!metric.empty()) {
    out.fit.metric = fitting::metric_named(metric);
    if (!out.fit.metric) throw Error(ErrorKind::usage, {"--metric", "'" + metric + "'", metric_list()});
  }
  for (const std::string& text : fixed) {
    const auto [name, value] = name_value(text, "--fix");
    out.fit.fixed[name] = number_from(value, "--fix " + name);
  }
  out.read = read.options();
  out.options = options_document(out.fit, read);
  std::string names;
  for (const std::string& model : models) names += (names.empty() ? "" : ",") + model;
  out.options.set("model", names);
  return out;
}

}  // namespace gonio::tools
