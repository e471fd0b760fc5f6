// SPDX-License-Identifier: BSD-3-Clause
#include "tools/brdf_source.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <optional>

#include "brdf/analytic_brdf.hpp"

namespace gonio::tools {

void ReadFlags::add_to(CLI::App& app) {
  app.add_option("--format", format, "Read the file as this format instead of recognising it");
  app.add_option("--columns", columns, "CSV: NAME=COLUMN,... by name or 1-based position");
  app.add_option("--set", set, "CSV: NAME=VALUE for a column the file does not have")->take_all();
  app.add_option("--quantity", quantity, "What the values are: f, f_cos, reflectance_factor, signal_ratio");
  app.add_option("--blank", blank, "CSV: subtract this file value by value at equal directions");
  app.add_option("--in-plane", in_plane, "A file without azimuths: specular-positive or specular-negative");
  app.add_option("--missing", missing, "Rows whose channels are all exactly this are no measurement (default -1), or none");
  app.add_option("--merl-nodes", merl_nodes, "MERL: where the first node of a cell lies, left or centre");
  app.add_option("--assume", assume, "KEY=VALUE: the answer to what the file does not say; the reader names what it needs")->take_all();
}

tabulated::MerlNodes merl_nodes_named(const std::string& text) {
  if (text == "left") return tabulated::MerlNodes::left;
  if (text == "centre") return tabulated::MerlNodes::centre;
  throw Error(ErrorKind::usage, {"--merl-nodes", "'" + text + "'", "left or centre"});
}

tabulated::ReadOptions ReadFlags::options() const {
  tabulated::ReadOptions out;
  if (!format.empty()) {
    std::string known;
    const auto& list = tabulated::formats();
    for (const auto& entry : list)
      if (entry.open) known += (known.empty() ? "" : ", ") + std::string(entry.name);
    if (std::none_of(list.begin(), list.end(), [&](const auto& entry) { return entry.open && format == entry.name; }))
      throw Error(ErrorKind::usage, {"--format", "'" + format + "'", "one of " + known});
    out.format = format;
  }
  for (const std::string& part : comma_separated(columns)) out.columns.push_back(name_value(part, "--columns"));
  for (const std::string& part : set) {
    const auto [name, value] = name_value(part, "--set");
    out.set[name] = number_from(value, "--set " + name);
  }
  if (!quantity.empty()) {
    out.quantity = quantity_named(quantity);
    if (!out.quantity) throw Error(ErrorKind::usage, {"--quantity", "'" + quantity + "'", "f, f_cos, reflectance_factor or signal_ratio"});
  }
  if (!blank.empty()) out.blank = blank;
  if (in_plane == "specular-positive")
    out.in_plane = tabulated::InPlane::specular_positive;
  else if (in_plane == "specular-negative")
    out.in_plane = tabulated::InPlane::specular_negative;
  else if (!in_plane.empty())
    throw Error(ErrorKind::usage, {"--in-plane", "'" + in_plane + "'", "specular-positive or specular-negative"});
  if (missing == "none")
    out.missing.reset();
  else if (!missing.empty())
    out.missing = number_from(missing, "--missing");
  if (!merl_nodes.empty()) out.merl_nodes = merl_nodes_named(merl_nodes);
  for (const std::string& text : assume) {
    const auto [key, answer] = name_value(text, "--assume");
    out.assume[key] = answer;
  }
  return out;
}

tabulated::Opened model_source(const std::string& model, const std::vector<std::string>& parameters) {
  const ModelInfo& info = model_info(model);
  std::vector<std::optional<double>> values(info.parameters.size());
  std::vector<Fault> faults;
  for (const std::string& text : parameters) {
    const auto given = name_value(text, "--param");
    const std::string &name = given.first, &value = given.second;
    const auto at = std::find_if(info.parameters.begin(), info.parameters.end(), [&](const Parameter& p) { return p.name == name; });
    if (at == info.parameters.end())
      faults.push_back({"--param", "'" + name + "'", "a parameter of " + model});
    else
      values[static_cast<std::size_t>(at - info.parameters.begin())] = number_from(value, "--param " + name);
  }
  std::vector<double> set;
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (!values[k])
      faults.push_back(
          {"--param", "no value for " + std::string(info.parameters[k].name), std::string(info.parameters[k].name) + "=VALUE"});
    set.push_back(values[k].value_or(0));
  }
  if (!faults.empty()) throw Error(ErrorKind::usage, "the parameters of model '" + model + "' are not complete", faults);
  tabulated::Opened out;
  out.format = "model";
  out.brdf = std::make_shared<AnalyticBrdf>(model, single_channel("value"), std::vector<std::vector<double>>{set});
  return out;
}

tabulated::Opened open_source(const std::string& source, const std::vector<std::string>& parameters, const ReadFlags& flags) {
  if (is_model(source)) return model_source(source, parameters);
  if (!parameters.empty())
    throw Error(ErrorKind::usage, {"--param", "parameters for the file '" + source + "'", "--param only with a model's name"});
  return tabulated::open_brdf(source, flags.options());
}

}  // namespace gonio::tools
