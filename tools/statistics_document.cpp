// SPDX-License-Identifier: BSD-3-Clause
#include "tools/statistics_document.hpp"

#include <cmath>
#include <future>
#include <limits>
#include <map>

#include "tools/output.hpp"

namespace gonio::tools {
namespace {

using fitting::SufficientStatistics;

Json count(std::size_t n) { return static_cast<std::int64_t>(n); }

template <class T>
Json column(const std::vector<T>& values) {
  Json::Array out;
  for (const T& value : values)
    if constexpr (std::is_same_v<T, std::size_t>)
      out.push_back(count(value));
    else
      out.push_back(Json(value));  // infinite becomes null
  return out;
}

std::vector<double> numbers(const Json& array) {
  std::vector<double> out;
  for (const Json& value : array.elements()) out.push_back(value.is_null() ? LobeGeometry::no_lobe : value.number());
  return out;
}

std::size_t size_from(const Json& value) { return static_cast<std::size_t>(value.integer()); }

HashedInput known_input(const Json& input) {
  std::promise<std::string> sha256;
  sha256.set_value(input.at("sha256").string());
  return {input.at("path").string(), sha256.get_future().share()};
}

DependsOn depends_on_from(const std::string& text) {
  for (const DependsOn value : {DependsOn::nothing, DependsOn::theta_h, DependsOn::psi})
    if (text == fitting::name(value)) return value;
  return DependsOn::all;
}

/// What the schema cannot say of a channel.
void check_columns(const SufficientStatistics::Channel& channel, std::size_t rows, const std::string& where, std::vector<Fault>& faults) {
  const auto check_size = [&](const char* name, std::size_t size) {
    if (size != rows)
      faults.push_back({where + "/" + name, std::to_string(size) + " values", std::to_string(rows) + ", one for every row"});
  };
  const std::size_t before = faults.size();
  check_size("weight", channel.weight.size());
  check_size("mean", channel.mean.size());
  check_size("within", channel.within.size());
  check_size("count", channel.count.size());
  if (faults.size() > before) return;
  for (std::size_t k = 0; k < rows; ++k)
    if ((channel.weight[k] > 0) != (channel.count[k] > 0))
      faults.push_back({where + "/count/" + std::to_string(k),
                        std::to_string(channel.count[k]) + " samples beside a weight of " + Json(channel.weight[k]).dump(),
                        "samples and a weight, or neither"});
}

/// Not the blank, and not the sidecar of a table: those serve many.
bool holds_samples(const HashedInput& input, const Json& options) {
  return !input.path.ends_with(".json") && !(options.contains("blank") && options.at("blank").string() == input.path);
}

}  // namespace

Json statistics_document(const Shard& shard, Json context) {
  const SufficientStatistics& s = shard.statistics;
  const bool all = s.depends_on == DependsOn::all;
  Json::Array angles, channels, correlated;
  for (const GonioAngles& a : s.angles)
    angles.push_back(Json::Array{a.theta_i.degrees(), a.phi_i.degrees(), a.theta_o.degrees(), a.phi_o.degrees()});
  for (std::size_t c = 0; c < s.channel.size(); ++c) {
    const SufficientStatistics::Channel& channel = s.channel[c];
    channels.push_back(Json::object({{"name", s.channels[c].name},
                                     {"weighted_value2", channel.weighted_value2},
                                     {"weight", column(channel.weight)},
                                     {"mean", column(channel.mean)},
                                     {"within", column(channel.within)},
                                     {"count", column(channel.count)}}));
  }
  for (const CorrelatedComponent& component : s.correlated)
    correlated.push_back(Json::object({{"name", component.name}, {"u", component.u}}));
  return Json::object({{"context", std::move(context)},
                       {"options", shard.options},
                       {"depends_on", fitting::name(s.depends_on)},
                       {"metric", fitting::name(s.metric)},
                       {"weighted", s.weighted},
                       {"rows", s.rows == SufficientStatistics::Rows::table_rows ? "table_rows" : "directions"},
                       {"log_cosine", all ? Json() : column(s.log_cosine)},
                       {"angles_deg", all ? Json(std::move(angles)) : Json()},
                       {"channels", std::move(channels)},
                       {"correlated", std::move(correlated)},
                       {"n_observations", count(s.n_observations)},
                       {"n_outliers", count(s.n_outliers)},
                       {"n_masked", masked_document(shard.masked, s.not_fitted)}});
}

Shard statistics_from(const Json& document, const std::string& source) {
  std::vector<Fault> faults = faults_of(document, Schema::statistics, source);
  const std::string message = source + " holds no statistics of gonio collapse";
  if (!faults.empty()) throw Error(ErrorKind::input, message, std::move(faults));
  Shard out;
  out.options = document.at("options");
  out.simulated = document.at("context").at("simulated").boolean();
  for (const Json& input : document.at("context").at("inputs").elements()) out.inputs.push_back(known_input(input));
  SufficientStatistics& s = out.statistics;
  s.depends_on = depends_on_from(document.at("depends_on").string());
  s.metric = *fitting::metric_named(document.at("metric").string());
  s.weighted = document.at("weighted").boolean();
  s.rows = document.at("rows").string() == "table_rows" ? SufficientStatistics::Rows::table_rows : SufficientStatistics::Rows::directions;
  const bool all = s.depends_on == DependsOn::all;
  const char* key = all ? "angles_deg" : "log_cosine";
  if (document.at(key).is_null())
    faults.push_back({source + "#/" + key, "null", std::string("the rows of statistics over ") + fitting::name(s.depends_on)});
  else if (!all)
    s.log_cosine = numbers(document.at(key));
  else
    for (const Json& row : document.at(key).elements())
      s.angles.push_back({degrees(row[0].number()), degrees(row[1].number()), degrees(row[2].number()), degrees(row[3].number())});
  if (all && s.rows == SufficientStatistics::Rows::table_rows)
    faults.push_back({source + "#/rows", "\"table_rows\" (string)", "directions, as depends_on is all"});
  const Json& channels = document.at("channels");
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const Json& channel = channels[c];
    SufficientStatistics::Channel sums{numbers(channel.at("weight")),
                                       numbers(channel.at("mean")),
                                       numbers(channel.at("within")),
                                       {},
                                       channel.at("weighted_value2").number()};
    for (const Json& value : channel.at("count").elements()) sums.count.push_back(size_from(value));
    check_columns(sums, s.row_count(), source + "#/channels/" + std::to_string(c), faults);
    s.channels.push_back(single_channel(channel.at("name").string()).front());
    s.channel.push_back(std::move(sums));
  }
  for (const Json& component : document.at("correlated").elements())
    s.correlated.push_back({component.at("name").string(), component.at("u").number(), {}});
  s.n_observations = size_from(document.at("n_observations"));
  s.n_outliers = size_from(document.at("n_outliers"));
  const Json& masked = document.at("n_masked");
  out.masked = {size_from(masked.at("nan")), size_from(masked.at("missing")), size_from(masked.at("below_horizon")),
                size_from(masked.at("blocked"))};
  for (const fitting::Omission omission : fitting::every_omission)
    s.not_fitted.add(omission, size_from(masked.at("not_fitted_by_reason").at(name(omission))));
  if (!faults.empty()) throw Error(ErrorKind::input, message, std::move(faults));
  return out;
}

Shard read_statistics(const std::filesystem::path& path) {
  return statistics_from(parse_json(read_file(path), path.string()), path.string());
}

Shard merge_shards(const std::vector<Shard>& shards, const std::vector<std::string>& names) {
  std::vector<Fault> faults;
  std::map<std::string, std::size_t> owner;
  std::vector<SufficientStatistics> parts;
  Shard out;
  for (std::size_t k = 0; k < shards.size(); ++k) {
    for (const HashedInput& input : shards[k].inputs) {
      out.inputs.push_back(input);
      if (!holds_samples(input, shards[k].options)) continue;
      const auto [entry, is_new] = owner.emplace(input.sha256.get(), k);
      if (!is_new)
        faults.push_back({names[k], input.path + ", which " + names[entry->second] + " holds already", "every file of samples once"});
    }
    parts.push_back(shards[k].statistics);
    out.masked.nan += shards[k].masked.nan;
    out.masked.missing += shards[k].masked.missing;
    out.masked.below_horizon += shards[k].masked.below_horizon;
    out.masked.blocked += shards[k].masked.blocked;
    out.simulated = out.simulated || shards[k].simulated;
    if (shards[k].options.get("metric") != shards.front().options.get("metric"))
      faults.push_back({names[k], "metric " + shards[k].options.get("metric").dump(), shards.front().options.get("metric").dump()});
  }
  if (!faults.empty()) throw Error(ErrorKind::input, "the shards do not belong together", std::move(faults));
  out.statistics = fitting::merge(parts);
  out.options = shards.front().options;
  return out;
}

}  // namespace gonio::tools
