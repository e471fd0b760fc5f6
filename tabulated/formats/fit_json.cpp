// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/formats/fit_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "brdf/analytic_brdf.hpp"
#include "data-schemas/document.hpp"
#include "tabulated/describe.hpp"
#include "tabulated/fault_list.hpp"

namespace gonio::tabulated {
namespace {

Channels channels_of(const Json& document) {
  std::vector<std::string> names;
  const auto add = [&](const Json& name) {
    if (name.is_string() && std::find(names.begin(), names.end(), name.string()) == names.end()) names.push_back(name.string());
  };
  if (const Json& listed = document.get("channels"); listed.is_array())
    for (const Json& name : listed.elements()) add(name);
  else
    for (const Json& parameter : document.at("parameters").elements()) add(parameter.at("channel"));
  if (names.empty()) names.emplace_back("value");
  Channels out;
  for (const std::string& name : names) out.push_back(single_channel(name).front());
  return out;
}

/// The value of a parameter for a channel: its own, or the shared one.
std::optional<double> value_of(const Json& parameters, std::string_view name, const std::string& channel) {
  std::optional<double> shared;
  for (const Json& parameter : parameters.elements()) {
    if (parameter.at("name").string() != name || !parameter.at("value").is_number()) continue;
    const Json& owner = parameter.at("channel");
    if (owner.is_null()) shared = parameter.at("value").number();
    if (owner.is_string() && owner.string() == channel) return parameter.at("value").number();
  }
  return shared;
}

std::string list_of_models() {
  std::string out;
  for (const ModelInfo& model : model_infos()) out += fmt::format("{}{}", out.empty() ? "" : ", ", model.name);
  return out;
}

}  // namespace

bool recognises_fit_json(std::string_view head, std::uintmax_t) {
  const std::size_t first = head.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && head[first] == '{' && head.find("\"context\"") != std::string_view::npos;
}

Opened open_fit_json(const std::filesystem::path& path, const ReadOptions&) {
  const Json any_document = parse_json(read_file(path), path.string());
  if (any_document.is_object() && any_document.get("model").is_null() && any_document.get("parameters").is_null())
    throw Error(ErrorKind::input,
                {path.string(), "a JSON document without a model and its parameters: another result, or the sidecar of a table",
                 "the document of a fit, or a BRDF as bird-json or openmaterial-json"});
  const Json document = load_document(path, Schema::fit);
  const auto where = [&](const std::string& pointer) { return fmt::format("{}#/{}", path.string(), pointer); };
  const std::string &model_name = document.at("model").string(), &status = document.at("status").string();
  FaultList faults(path.string());
  const ModelInfo* model = is_model(model_name) ? &model_info(model_name) : nullptr;
  if (model == nullptr) faults.add(where("model"), excerpt(model_name), fmt::format("one of {}, or a sum a+b of them", list_of_models()));
  if (status == "no_usable_data" || status == "failed") faults.add(where("status"), excerpt(status), "a fit that has values");
  faults.raise();

  const Channels channels = channels_of(document);
  std::vector<std::vector<double>> values(channels.size());
  for (std::size_t c = 0; c < channels.size(); ++c)
    for (const Parameter& parameter : model->parameters) {
      const auto value = value_of(document.at("parameters"), parameter.name, channels[c].name);
      if (!value)
        faults.add(where("parameters"), fmt::format("no value of {} for channel {}", parameter.name, channels[c].name),
                   "one, or one shared by all channels");
      else if (*value < parameter.lower || *value > parameter.upper)
        faults.add(where("parameters"), fmt::format("{} = {}", parameter.name, *value),
                   fmt::format("a number from {} to {}", parameter.lower, parameter.upper));
      values[c].push_back(value.value_or(0));
    }
  faults.raise();

  Opened out;
  out.format = "fit-json";
  out.simulated = document.at("context").boolean_or("simulated", false);
  out.info = {{"holds", "parameters of a model of f, cosine not included"},
              {"unit", "1/sr"},
              {"nodes", "none: a formula"},
              {"model", model_name},
              {"status", status},
              {"metric", document.at("metric").string()},
              {"channels", joined_names(channels)}};
  for (std::size_t c = 0; c < channels.size(); ++c) {
    std::string text;
    for (std::size_t k = 0; k < model->parameters.size(); ++k)
      text += fmt::format("{}{} = {:.6g}", k == 0 ? "" : ", ", model->parameters[k].name, values[c][k]);
    out.info.emplace_back(fmt::format("parameters of {}", channels[c].name), text);
  }
  out.info.emplace_back("citation", model->citation);
  out.info.emplace_back("symmetry", words(AnalyticBrdf(model_name, channels, values).symmetry()));
  out.info.emplace_back("simulated", out.simulated ? "yes" : "no");
  out.brdf = std::make_shared<const AnalyticBrdf>(model_name, channels, std::move(values));
  return out;
}

}  // namespace gonio::tabulated
