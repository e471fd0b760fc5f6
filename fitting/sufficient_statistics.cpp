// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/sufficient_statistics.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>

#include "brdf/error.hpp"

namespace gonio::fitting {
namespace {

/// Two weighted means with their centred sums of squares as one (Chan, Golub and LeVeque 1979).
void add(SufficientStatistics::Channel& to, std::size_t row, double weight, double mean, double within, std::size_t count) {
  if (!(weight > 0)) return;
  const double all = to.weight[row] + weight, apart = mean - to.mean[row];
  to.within[row] += within + apart * apart * to.weight[row] * (weight / all);
  to.mean[row] += apart * (weight / all);
  to.weight[row] = all;
  to.count[row] += count;
}

void append_row(SufficientStatistics& to) {
  for (SufficientStatistics::Channel& channel : to.channel) {
    channel.weight.push_back(0);
    channel.mean.push_back(0);
    channel.within.push_back(0);
    channel.count.push_back(0);
  }
}

/// Finds the row of a geometry, or appends one.
class Rows {
 public:
  explicit Rows(SufficientStatistics& statistics) : statistics_(statistics) {
    for (std::size_t row = 0; row < statistics.row_count(); ++row)
      rows_.emplace(statistics.depends_on == DependsOn::all ? key(statistics.angles[row]) : Key{statistics.log_cosine[row]}, row);
  }
  std::size_t row(double log_cosine) {
    const auto [entry, is_new] = rows_.try_emplace(Key{log_cosine}, statistics_.row_count());
    if (is_new) statistics_.log_cosine.push_back(log_cosine), append_row(statistics_);
    return entry->second;
  }
  std::size_t row(const GonioAngles& angles) {
    const auto [entry, is_new] = rows_.try_emplace(key(angles), statistics_.row_count());
    if (is_new) statistics_.angles.push_back(angles), append_row(statistics_);
    return entry->second;
  }

 private:
  using Key = std::array<double, 4>;
  static Key key(const GonioAngles& a) { return {a.theta_i.degrees(), a.phi_i.degrees(), a.theta_o.degrees(), a.phi_o.degrees()}; }

  SufficientStatistics& statistics_;
  std::map<Key, std::size_t> rows_;
};

double log_cosine_of(const LobeGeometry& geometry, DependsOn depends_on) {
  return depends_on == DependsOn::psi ? geometry.log_cos_psi : depends_on == DependsOn::theta_h ? geometry.log_cos_h : 0;
}

/// Rows of the same table stay apart, directions that are the same become one.
void append(SufficientStatistics& to, const SufficientStatistics& part) {
  std::optional<Rows> rows;
  if (to.rows == SufficientStatistics::Rows::directions) rows.emplace(to);
  for (std::size_t k = 0; k < part.row_count(); ++k) {
    std::size_t row = to.row_count();
    if (!rows)
      to.log_cosine.push_back(part.log_cosine[k]), append_row(to);
    else
      row = to.depends_on == DependsOn::all ? rows->row(part.angles[k]) : rows->row(part.log_cosine[k]);
    for (std::size_t c = 0; c < to.channel.size(); ++c) {
      const SufficientStatistics::Channel& more = part.channel[c];
      add(to.channel[c], row, more.weight[k], more.mean[k], more.within[k], more.count[k]);
    }
  }
  for (std::size_t c = 0; c < to.channel.size(); ++c) to.channel[c].weighted_value2 += part.channel[c].weighted_value2;
  to.n_observations += part.n_observations;
  to.not_fitted += part.not_fitted;
  to.n_outliers += part.n_outliers;
}

/// Where two parts differ in what must be equal.
std::vector<Fault> differences(const SufficientStatistics& first, const SufficientStatistics& part, std::size_t number) {
  const std::string where = "part " + std::to_string(number);
  std::vector<Fault> out;
  const auto compare = [&](const char* what, const std::string& found, const std::string& wanted) {
    if (found != wanted) out.push_back({where, std::string(what) + " " + found, std::string(what) + " " + wanted});
  };
  const auto names = [](const auto& list) {
    std::string text;
    for (const auto& item : list) text += (text.empty() ? "" : ", ") + item.name;
    return text;
  };
  const auto sizes = [](const SufficientStatistics& s) {
    std::vector<double> u;
    for (const CorrelatedComponent& component : s.correlated) u.push_back(component.u);
    return u;
  };
  compare("statistics over", name(part.depends_on), name(first.depends_on));
  compare("metric", name(part.metric), name(first.metric));
  compare("weights from", part.weighted ? "uncertainties" : "nothing", first.weighted ? "uncertainties" : "nothing");
  compare("rows of", part.rows == SufficientStatistics::Rows::table_rows ? "tables" : "directions",
          first.rows == SufficientStatistics::Rows::table_rows ? "tables" : "directions");
  compare("channels", names(part.channels), names(first.channels));
  compare("correlated components", names(part.correlated), names(first.correlated));
  if (out.empty() && sizes(part) != sizes(first)) out.push_back({where, "correlated components of another size", "the same"});
  return out;
}

}  // namespace

const char* name(DependsOn depends_on) noexcept {
  switch (depends_on) {
    case DependsOn::nothing: return "nothing";
    case DependsOn::theta_h: return "theta_h";
    case DependsOn::psi: return "psi";
    case DependsOn::all: return "all";
  }
  return "all";
}

SufficientStatistics sufficient_statistics(const Observations& observations, const FitOptions& options) {
  const ModelKernel kernel = model_kernel(options.model);
  SufficientStatistics out;
  out.depends_on = kernel.info->depends_on;
  out.metric = options.metric.value_or(Metric::linear);
  if (out.metric == Metric::log1p && out.depends_on != DependsOn::all)
    throw Error(ErrorKind::usage,
                {"metric", "log1p, which differs from sample to sample of a row", "another metric, or a model of all angles"});
  out.correlated = observations.correlated();
  for (const CorrelatedComponent& component : out.correlated)
    if (!component.sensitivity.empty())
      throw Error(ErrorKind::input,
                  {"correlated component " + component.name, "a sensitivity for every sample", "one that is common to all"});

  const bool by_default = options.weights == Weights::automatic && !options.metric;
  const Robust robust = options.robust.value_or(by_default ? Robust::automatic : Robust::none);
  const Terms terms = make_terms(observations, kernel, out.metric, options.threads, robust, options.weights);
  out.weighted = terms.weighted;
  require_estimable(terms.weighted, terms.collapsed ? SufficientStatistics::Rows::table_rows : SufficientStatistics::Rows::directions,
                    options);
  out.rows = terms.collapsed ? SufficientStatistics::Rows::table_rows : SufficientStatistics::Rows::directions;
  out.channels = observations.channels();
  out.channel.resize(out.channels.size());
  out.n_observations = terms.n_observations;
  out.not_fitted = terms.not_fitted;
  out.n_outliers = terms.outliers.size();

  std::vector<GonioAngles> angles;
  if (!terms.collapsed && out.depends_on == DependsOn::all)
    for (std::size_t b = 0; b < observations.block_count(); ++b) {
      std::vector<GonioAngles> part;
      observations.angles(b, part);
      angles.insert(angles.end(), part.begin(), part.end());
    }
  Rows rows(out);
  for (std::size_t k = 0; k < terms.rows(); ++k) {
    std::size_t row = out.row_count();
    if (terms.collapsed)
      out.log_cosine.push_back(log_cosine_of(terms.geometry[k], out.depends_on)), append_row(out);
    else
      row =
          out.depends_on == DependsOn::all ? rows.row(angles[terms.sample[k]]) : rows.row(log_cosine_of(terms.geometry[k], out.depends_on));
    for (std::size_t c = 0; c < out.channel.size(); ++c) {
      const ChannelTerms& data = terms.channel[c];
      if (terms.collapsed)
        add(out.channel[c], row, data.weight[k], data.target[k], data.row_within[k], data.row_count[k]);
      else
        add(out.channel[c], row, data.weight[k], data.target[k], 0, 1);
    }
  }
  for (std::size_t c = 0; c < out.channel.size(); ++c) out.channel[c].weighted_value2 = terms.channel[c].weighted_value2;
  return out;
}

void require_estimable(bool weighted, SufficientStatistics::Rows rows, const FitOptions& options) {
  if (options.weights == Weights::solid_angle || (weighted && options.weights == Weights::none))
    throw Error(ErrorKind::usage,
                {"weights", name(options.weights), weighted ? "uncertainty, which the sums were made with" : "none, or those of the data"});
  if (rows == SufficientStatistics::Rows::table_rows) return;
  const bool by_default = options.weights == Weights::automatic && !options.metric;
  if (!weighted && (by_default || options.weights == Weights::variance))
    throw Error(ErrorKind::usage, {"weights", "a variance model of scattered samples, which their sums cannot give",
                                   "a metric (--metric), or --weights none"});
  if (options.robust.value_or(Robust::none) != Robust::none)
    throw Error(ErrorKind::usage, {"robust", name(*options.robust), "none: sums over scattered samples do not show wrong readings"});
}

SufficientStatistics merge(const std::vector<SufficientStatistics>& parts) {
  if (parts.empty()) throw Error(ErrorKind::input, {"statistics", "no part", "at least one"});
  std::vector<Fault> faults;
  for (std::size_t p = 1; p < parts.size(); ++p) {
    const std::vector<Fault> more = differences(parts.front(), parts[p], p + 1);
    faults.insert(faults.end(), more.begin(), more.end());
  }
  if (!faults.empty()) throw Error(ErrorKind::input, "the parts do not belong together", std::move(faults));
  SufficientStatistics out = parts.front();
  for (std::size_t p = 1; p < parts.size(); ++p) append(out, parts[p]);
  return out;
}

Terms make_terms(const SufficientStatistics& statistics, const ModelKernel& kernel) {
  const DependsOn wanted = kernel.info->depends_on;
  if (wanted != statistics.depends_on && wanted != DependsOn::nothing && statistics.depends_on != DependsOn::all)
    throw Error(ErrorKind::usage, {"model " + kernel.info->name, std::string("statistics over ") + name(statistics.depends_on),
                                   std::string("statistics over ") + name(wanted)});
  Terms terms;
  terms.kernel = kernel;
  terms.transform = {statistics.metric};
  terms.weighted = statistics.weighted;
  terms.collapsed = true;
  terms.rows_of = statistics.rows == SufficientStatistics::Rows::table_rows ? RowsOf::table_rows : RowsOf::directions;
  terms.n_observations = statistics.n_observations;
  terms.not_fitted = statistics.not_fitted;
  for (const GonioAngles& angles : statistics.angles) terms.geometry.push_back(lobe_geometry(angles));
  for (const double log_cosine : statistics.log_cosine) {
    LobeGeometry geometry;
    (statistics.depends_on == DependsOn::psi ? geometry.log_cos_psi : geometry.log_cos_h) = log_cosine;
    terms.geometry.push_back(geometry);
  }
  for (const SufficientStatistics::Channel& channel : statistics.channel) {
    ChannelTerms data;
    data.target = channel.mean;
    data.weight = channel.weight;
    data.row_within = channel.within;
    data.row_count = channel.count;
    data.weighted_value2 = channel.weighted_value2;
    for (std::size_t k = 0; k < channel.count.size(); ++k) data.within += channel.within[k], data.count += channel.count[k];
    terms.channel.push_back(std::move(data));
  }
  return terms;
}

}  // namespace gonio::fitting
