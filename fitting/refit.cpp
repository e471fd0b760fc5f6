// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/refit.hpp"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "brdf/coordinates.hpp"
#include "brdf/error.hpp"

namespace gonio::fitting {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double widest_deg = 80;           ///< beyond, models part and instruments see nothing
constexpr std::size_t most_samples = 8192;  ///< of a data set; several times what a dozen parameters need
constexpr double known_enough = 0.999;      ///< part of an incidence's weight that must be known for its albedo
constexpr std::array incidence_deg{0.0, 30.0, 60.0};

struct Midpoint {
  double at, width;
};
Midpoint midpoint(int k, int n, double range) { return {(k + 0.5) * range / n, range / n}; }
/// theta_h = range u², u at midpoints.
Midpoint root_midpoint(int k, int n, double range) {
  const double u = (k + 0.5) / n;
  return {range * u * u, 2 * range * u / n};
}

void add(RefitData& data, const std::vector<double>& f, const Direction& wi, const Direction& wo, double weight) {
  if (!std::all_of(f.begin(), f.end(), [](double v) { return std::isfinite(v); })) return;
  data.wi.push_back(wi), data.wo.push_back(wo), data.weight.push_back(weight);
  for (const double value : f) data.f.push_back(std::max(0.0, value));
}

void add_grid(RefitData& data, const Brdf& source) {
  const int nh = data.isotropic ? 24 : 16, nd = data.isotropic ? 12 : 8, np = 8, nx = data.isotropic ? 1 : 8;
  const double lowest = degrees(widest_deg).cos();
  for (int a = 0; a < nh; ++a)
    for (int b = 0; b < nd; ++b)
      for (int c = 0; c < np; ++c)
        for (int d = 0; d < nx; ++d) {
          const Midpoint th = root_midpoint(a, nh, pi / 2), td = midpoint(b, nd, pi / 2), pd = midpoint(c, np, 2 * pi),
                         ph = midpoint(d, nx, 2 * pi);
          // Away from planes of symmetry, in which a grid would see only one half of an odd function.
          const double turn = data.isotropic ? 0 : ph.at;
          const auto [wi, wo] = directions(HalfDifference{radians(th.at), radians(turn), radians(td.at), radians(pd.at)});
          if (!(wi.z() >= lowest && wo.z() >= lowest)) continue;
          const double measure = 4 * std::cos(td.at) * std::sin(th.at) * th.width * std::sin(td.at) * td.width * pd.width * ph.width;
          add(data, source.eval(wi, wo), wi, wo, measure * wi.z() * wo.z());
        }
}

void add_samples(RefitData& data, const Dataset& samples) {
  const std::size_t every = std::max<std::size_t>(1, (samples.size() + most_samples - 1) / most_samples);
  const double lowest = degrees(widest_deg).cos();
  std::vector<double> f(data.channel_count);
  for (std::size_t k = 0; k < samples.size(); k += every) {
    const Direction wi = samples.angles[k].wi(), wo = samples.angles[k].wo();
    if (!(wi.z() >= lowest && wo.z() >= lowest)) continue;
    for (std::size_t c = 0; c < f.size(); ++c) f[c] = samples.f[c][k];
    add(data, f, wi, wo, 1);
  }
}

/// Whether the light came from one azimuth only: such samples say nothing about anisotropy.
bool one_azimuth(const Dataset& samples) {
  constexpr double same = 1e-6;  // degrees
  return std::all_of(samples.angles.begin(), samples.angles.end(), [&](const GonioAngles& a) {
    return a.theta_i.sin() < same || std::abs((a.phi_i - samples.angles.front().phi_i).degrees()) < same;
  });
}

void add_incidence(RefitData& data, const Brdf& source, double theta_deg) {
  constexpr int nh = 24, np = 16;
  RefitData::Incidence out;
  // A quarter of a degree off the axes: no node lies where atan2 of a table jumps.
  out.wi = Direction::spherical(degrees(theta_deg), degrees(0.25));
  std::vector<double> sum(data.channel_count);
  double known = 0, all = 0;
  for (int a = 0; a < nh; ++a)
    for (int b = 0; b < np; ++b) {
      const Midpoint th = root_midpoint(a, nh, pi / 2), ph = midpoint(b, np, 2 * pi);
      const Direction h = Direction::spherical(radians(th.at), radians(ph.at));
      const double c = dot(out.wi, h);
      const double x = 2 * c * h.x() - out.wi.x(), y = 2 * c * h.y() - out.wi.y(), z = 2 * c * h.z() - out.wi.z();
      if (!(c > 0 && z > 0)) continue;
      const Direction wo = Direction::trusted(x, y, z);
      const double weight = 4 * c * std::sin(th.at) * th.width * ph.width * z;
      const std::vector<double> f = source.eval(out.wi, wo);
      all += weight;
      if (!std::all_of(f.begin(), f.end(), [](double v) { return std::isfinite(v); })) continue;
      known += weight;
      out.wo.push_back(wo), out.weight.push_back(weight);
      for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += weight * f[k];
    }
  const bool enough = all > 0 && known >= known_enough * all;
  out.albedo = enough ? sum : std::vector<double>(sum.size(), std::numeric_limits<double>::quiet_NaN());
  data.incidences.push_back(std::move(out));
}

/// Added to an albedo before its logarithm is taken: less is black.
constexpr double black = 1e-3;

/// [incidence · C + channel] of ln(albedo + black); NaN where the source's is not known.
std::vector<double> log_albedos(const RefitData& data, const EvaluateFormula& formula) {
  const std::size_t n = data.channel_count;
  std::vector<double> out, f(n), sum(n);
  for (const RefitData::Incidence& incidence : data.incidences) {
    std::fill(sum.begin(), sum.end(), 0.0);
    for (std::size_t k = 0; k < incidence.wo.size(); ++k) {
      formula(incidence.wi, incidence.wo[k], f.data());
      for (std::size_t c = 0; c < n; ++c) sum[c] += incidence.weight[k] * f[c];
    }
    for (const double albedo : sum) out.push_back(std::log(std::max(0.0, albedo) + black));
  }
  return out;
}
std::vector<double> log_albedos(const RefitData& data) {
  std::vector<double> out;
  for (const RefitData::Incidence& incidence : data.incidences)
    for (const double albedo : incidence.albedo) out.push_back(std::log(std::max(0.0, albedo) + black));
  return out;
}

double lit(double f, double cos_o) { return std::log(f * cos_o + dark_floor); }

/// The residuals of all pairs and channels as a function of the free parameters.
class Residuals final : public ceres::CostFunction {
 public:
  /// A free parameter: its place in the formula and, of one per channel, the channel.
  struct Free {
    std::size_t parameter;
    std::optional<std::size_t> channel;
  };

  Residuals(const RefitData& data, const TargetFormula& formula, ChannelValues base, std::vector<Free> free)
      : data_(data), formula_(formula), base_(std::move(base)), free_(std::move(free)) {
    for (std::size_t k = 0; k < data.size(); ++k)
      for (std::size_t c = 0; c < data.channel_count; ++c) target_.push_back(lit(data.f[k * data.channel_count + c], data.wo[k].z()));
    scale_.assign(target_.size(), 1 / std::sqrt(static_cast<double>(target_.size())));
    const std::vector<double> albedos = log_albedos(data);
    const auto known = std::count_if(albedos.begin(), albedos.end(), [](double a) { return std::isfinite(a); });
    for (const double albedo : albedos) {
      target_.push_back(std::isfinite(albedo) ? albedo : 0);
      scale_.push_back(std::isfinite(albedo) ? 1 / std::sqrt(static_cast<double>(known)) : 0);
    }
    mutable_parameter_block_sizes()->push_back(static_cast<int>(free_.size()));
    set_num_residuals(static_cast<int>(target_.size()));
  }

  ChannelValues values(const double* x) const {
    ChannelValues out = base_;
    for (std::size_t j = 0; j < free_.size(); ++j)
      for (std::size_t c = 0; c < out.size(); ++c)
        if (!free_[j].channel || *free_[j].channel == c) out[c][free_[j].parameter] = x[j];
    return out;
  }

  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override {
    const ChannelValues at = values(x[0]);
    logs(at, residuals);
    for (std::size_t r = 0; r < target_.size(); ++r) residuals[r] = scale_[r] * (residuals[r] - target_[r]);
    if (jacobians && jacobians[0]) differentiate(at, residuals, jacobians[0]);
    return std::all_of(residuals, residuals + target_.size(), [](double r) { return std::isfinite(r); });
  }

 private:
  void logs(const ChannelValues& values, double* out) const {
    const EvaluateFormula evaluate = formula_.prepare(values);
    const std::size_t n = data_.channel_count;
    for (std::size_t k = 0; k < data_.size(); ++k) {
      evaluate(data_.wi[k], data_.wo[k], out + k * n);
      for (std::size_t c = 0; c < n; ++c) out[k * n + c] = lit(std::max(0.0, out[k * n + c]), data_.wo[k].z());
    }
    const std::vector<double> albedos = log_albedos(data_, evaluate);
    std::copy(albedos.begin(), albedos.end(), out + data_.f.size());
  }

  /// Differences away from the nearer bound. A parameter per channel is moved in all channels at once: channels do not mix.
  void differentiate(const ChannelValues& at, const double* residuals, double* jacobian) const {
    const std::size_t n = data_.channel_count, columns = free_.size();
    std::fill(jacobian, jacobian + target_.size() * columns, 0.0);
    std::vector<double> moved(target_.size()), step(n);
    for (std::size_t p = 0; p < formula_.parameters.size(); ++p) {
      const auto first = std::find_if(free_.begin(), free_.end(), [&](const Free& f) { return f.parameter == p; });
      if (first == free_.end()) continue;
      ChannelValues next = at;
      for (std::size_t c = 0; c < n; ++c) {
        const double h = 1e-6 * std::max(std::abs(at[c][p]), 1e-2);
        next[c][p] += at[c][p] + h <= formula_.parameters[p].upper ? h : -h;
        step[c] = next[c][p] - at[c][p];
      }
      logs(next, moved.data());
      for (std::size_t r = 0; r < target_.size(); ++r) {
        const std::size_t c = r % n;
        const double slope = (scale_[r] * (moved[r] - target_[r]) - residuals[r]) / step[c];
        for (std::size_t j = 0; j < columns; ++j)
          if (free_[j].parameter == p && (!free_[j].channel || *free_[j].channel == c)) jacobian[r * columns + j] = slope;
      }
    }
  }

  const RefitData& data_;
  const TargetFormula& formula_;
  ChannelValues base_;
  std::vector<Free> free_;
  std::vector<double> target_, scale_;  ///< pairs first, then incidences; channel by channel in each
};

struct End {
  ChannelValues values;
  double cost = std::numeric_limits<double>::infinity();
};

End descend(const RefitData& data, const TargetFormula& formula, const ChannelValues& start, int iterations) {
  std::vector<Residuals::Free> free;
  std::vector<double> x;
  ChannelValues base = start;
  for (std::size_t p = 0; p < formula.parameters.size(); ++p) {
    const FormulaParameter& parameter = formula.parameters[p];
    if (data.isotropic && parameter.if_isotropic) {
      for (auto& set : base) set[p] = *parameter.if_isotropic;
      continue;
    }
    for (std::size_t c = 0; c < (parameter.per_channel ? base.size() : 1); ++c) {
      free.push_back({p, parameter.per_channel ? std::optional(c) : std::nullopt});
      x.push_back(std::clamp(base[c][p], parameter.lower, parameter.upper));
    }
  }
  Residuals residuals(data, formula, base, free);
  ceres::Problem::Options problem_options;
  problem_options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(problem_options);
  problem.AddResidualBlock(&residuals, nullptr, x.data());
  for (std::size_t j = 0; j < free.size(); ++j) {
    problem.SetParameterLowerBound(x.data(), static_cast<int>(j), formula.parameters[free[j].parameter].lower);
    problem.SetParameterUpperBound(x.data(), static_cast<int>(j), formula.parameters[free[j].parameter].upper);
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = iterations;
  options.function_tolerance = 1e-10;
  options.parameter_tolerance = 1e-10;
  options.gradient_tolerance = 1e-14;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  return {residuals.values(x.data()), summary.IsSolutionUsable() ? summary.final_cost : std::numeric_limits<double>::infinity()};
}

constexpr int first_look = 8;   ///< iterations from every start
constexpr int to_the_end = 50;  ///< from the best ends of the first look

constexpr double worth_following = 4;  ///< ends of the first look with no more than this times the best cost

/// The best of the ends from several starts.
End best_end(const RefitData& data, const TargetFormula& formula, const std::vector<ChannelValues>& starts) {
  std::vector<End> ends;
  for (const ChannelValues& start : starts) ends.push_back(descend(data, formula, start, first_look));
  std::stable_sort(ends.begin(), ends.end(), [](const End& a, const End& b) { return a.cost < b.cost; });
  End best = ends.front();
  for (std::size_t k = 0; k < std::min<std::size_t>(3, ends.size()); ++k) {
    if (ends[k].cost > worth_following * ends.front().cost) break;
    End end = descend(data, formula, ends[k].values, to_the_end);
    if (end.cost < best.cost) best = std::move(end);
  }
  return best;
}

}  // namespace

RefitData refit_data(const Brdf& source, const Dataset* samples) {
  RefitData data;
  data.channel_count = source.channels().size();
  data.isotropic = source.symmetry().isotropic || (samples && one_azimuth(*samples));
  data.at_samples = samples != nullptr;
  if (samples)
    add_samples(data, *samples);
  else
    add_grid(data, source);
  if (data.size() == 0)
    throw Error(ErrorKind::input, {"source", "no value at zenith angles up to 80°", "a BRDF that is known somewhere above the surface"});
  if (std::all_of(data.f.begin(), data.f.end(), [](double f) { return f == 0; }))
    throw Error(ErrorKind::input,
                {"source", "0 or less at every pair of directions", "a BRDF that reflects light: black has no lobe to fit"});
  // Between samples lies no more than an interpolation, and beyond them less: no albedo of theirs counts.
  if (!samples)
    for (const double theta : incidence_deg) add_incidence(data, source, theta);
  return data;
}

RefitErrors refit_errors(const RefitData& data, const EvaluateFormula& formula) {
  const std::size_t n = data.channel_count;
  std::vector<double> f(n);
  double logs = 0, squares = 0, relative = 0, weights = 0;
  for (std::size_t k = 0; k < data.size(); ++k) {
    formula(data.wi[k], data.wo[k], f.data());
    for (std::size_t c = 0; c < n; ++c) {
      const double wanted = data.f[k * n + c], cos_o = data.wo[k].z();
      const double log_gap = lit(std::max(0.0, f[c]), cos_o) - lit(wanted, cos_o), gap = (f[c] - wanted) * cos_o;
      logs += log_gap * log_gap;
      squares += gap * gap;
      relative += data.weight[k] * std::abs(gap) / (wanted * cos_o + dark_floor), weights += data.weight[k];
    }
  }
  const double count = static_cast<double>(data.f.size());
  RefitErrors out;
  out.log_rms = std::sqrt(logs / count);
  out.mean_relative = weights > 0 ? relative / weights : 0;
  out.rms_f_cos = std::sqrt(squares / count);
  const std::vector<double> albedos = log_albedos(data, formula), wanted = log_albedos(data);
  double albedo_squares = 0, known = 0;
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    if (!std::isfinite(wanted[k])) continue;
    albedo_squares += (albedos[k] - wanted[k]) * (albedos[k] - wanted[k]), ++known;
    const double gap = std::exp(albedos[k]) - std::exp(wanted[k]);
    if (std::abs(gap) >= std::abs(out.albedo_difference.value_or(0))) out.albedo_difference = gap;
  }
  out.misfit = std::sqrt(logs / count + (known > 0 ? albedo_squares / known : 0));
  return out;
}

Refit refit(const RefitData& data, const TargetFormula& formula, const LobeSummary& summary) {
  const std::vector<ChannelValues> starts = formula.starts(summary);
  Refit out;
  out.naive = starts.front();
  out.naive_errors = refit_errors(data, formula.prepare(out.naive));
  out.values = best_end(data, formula, starts).values;
  out.errors = refit_errors(data, formula.prepare(out.values));
  if (!(out.errors.misfit <= out.naive_errors.misfit)) out.values = out.naive, out.errors = out.naive_errors;
  for (std::size_t p = 0; p < formula.parameters.size(); ++p) {
    const FormulaParameter& parameter = formula.parameters[p];
    if (data.isotropic && parameter.if_isotropic) continue;
    const double near = 1e-9 * (parameter.upper - parameter.lower);
    const auto at_end = [&](double value) { return value <= parameter.lower + near || value >= parameter.upper - near; };
    bool put_there = false;
    for (std::size_t c = 0; c < out.values.size(); ++c) put_there = put_there || (at_end(out.values[c][p]) && !at_end(out.naive[c][p]));
    if (put_there) out.at_bound.push_back(p);
  }
  return out;
}

LobeSummary fitted_summary(const RefitData& data, const TargetFormula& reference, LobeSummary (*summarise)(const ChannelValues&)) {
  const std::size_t n = data.channel_count;
  LobeSummary guess;
  std::vector<double> sorted(data.size());
  for (std::size_t c = 0; c < n; ++c) {
    for (std::size_t k = 0; k < data.size(); ++k) sorted[k] = data.f[k * n + c];
    std::sort(sorted.begin(), sorted.end());
    guess.rho_d.push_back(std::min(1.0, pi * sorted[sorted.size() / 4]));
    guess.f0.push_back(0.05);
    guess.f90.push_back(1);
  }
  std::vector<ChannelValues> starts;
  for (const double alpha : {0.03, 0.1, 0.3, 0.7}) {
    guess.alpha_x = guess.alpha_y = alpha;
    for (const double f0 : {0.05, 0.5}) {
      guess.f0.assign(n, f0);
      starts.push_back(reference.starts(guess).front());
    }
  }
  return summarise(best_end(data, reference, starts).values);
}

}  // namespace gonio::fitting
