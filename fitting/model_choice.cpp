// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/model_choice.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <tuple>

#include <fmt/format.h>

#include "brdf/error.hpp"
#include "fitting/corrected.hpp"
#include "fitting/scrambled.hpp"
#include "fitting/subset.hpp"
#include "fitting/threads.hpp"

namespace gonio::fitting {
namespace {

/// Enough samples that a model of a dozen parameters is held against thousands of each incidence.
constexpr std::size_t most_samples = std::size_t{1} << 14;
/// Scores nearer than this are one: the exponent itself is only refined to 1e-9.
constexpr double tie = 1e-6;

std::size_t index_of(Metric metric) {
  return static_cast<std::size_t>(std::find(every_metric.begin(), every_metric.end(), metric) - every_metric.begin());
}

/// Every sample, or of many a pseudo-random part of them.
std::vector<std::uint8_t> thinned(std::size_t samples) {
  std::vector<std::uint8_t> keep(samples, 1);
  if (samples <= most_samples) return keep;
  const auto limit = static_cast<std::uint64_t>(std::ldexp(static_cast<double>(most_samples) / static_cast<double>(samples), 64));
  for (std::size_t k = 0; k < samples; ++k) {
    keep[k] = scrambled(k) < limit;
  }
  return keep;
}

/// A fit, or why there is none.
struct Attempt {
  FitResult fit;
  std::string refused;
};

Attempt attempt(const Observations& observations, const ChoiceOptions& options, FitOptions fit_options, std::size_t total) {
  if (options.stop && *options.stop) throw Error(ErrorKind::interrupted, {"model choice", "a signal", "a run to the end"});
  fit_options.threads = 1;
  Attempt out;
  try {
    out.fit = fit(observations, fit_options);
    if (out.fit.status != Status::converged) out.refused = out.fit.reason.empty() ? name(out.fit.status) : out.fit.reason;
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::usage) throw;
    out.refused = error.faults().empty() ? error.message() : error.faults().front().found + ": " + error.message();
  }
  if (options.fitted) options.fitted(total);
  return out;
}

std::string unidentified(const FitResult& fit) {
  std::string names;
  for (const FittedParameter& p : fit.parameters) {
    if (p.kind != IntervalKind::unidentified) continue;
    names += (names.empty() ? "" : ", ") + p.name + (p.channel && fit.channels.size() > 1 ? " of " + fit.channels[*p.channel].name : "");
  }
  return names.empty() ? "" : "the data do not determine " + names;
}

std::string second_lobe(const FitResult& fit) {
  if (fit.other_minima.empty() || fit.other_minima.front().nonlinear.empty() || fit.values.empty()) return {};
  const ModelInfo& model = model_info(fit.model);
  const std::vector<double>& other = fit.other_minima.front().nonlinear;
  std::string best_text, other_text;
  for (std::size_t k = 0; k < std::min(other.size(), model.nonlinear_count()); ++k) {
    const std::size_t place = model.linear_count + k;
    best_text += fmt::format("{}{} = {:.4g}", k ? ", " : "", model.parameters[place].name, fit.values.front()[place]);
    other_text += fmt::format("{}{:.4g}", k ? ", " : "", other[k]);
  }
  return fmt::format("its profile has another minimum, {} beside {}, at {:.3g} times the cost: often a second lobe, try {}+{}", other_text,
                     best_text, fit.other_minima.front().cost_ratio, fit.model, fit.model);
}

/// The lobes that only differ by their normalisation fit alike.
std::string same_as(const Candidate& candidate, const std::vector<Candidate>& earlier) {
  const auto alike = [](double a, double b) { return std::abs(a - b) <= tie * std::max(std::abs(a), std::abs(b)); };
  for (const Candidate& other : earlier) {
    const FitErrors &a = candidate.fit.errors, &b = other.fit.errors;
    if (other.ranked && other.free_parameters == candidate.free_parameters && alike(a.linear, b.linear) &&
        alike(a.linear_cos, b.linear_cos) && alike(a.log1p, b.log1p) && alike(a.cbrt, b.cbrt))
      return "it fits as " + other.model + " does";
  }
  return {};
}

void add_note(std::string& text, const std::string& note) {
  if (!note.empty()) text += (text.empty() ? "" : "; ") + note;
}

class Choice {
 public:
  Choice(std::shared_ptr<const Observations> observations, const ChoiceOptions& options)
      : observations_(std::move(observations)), options_(options) {
    for (const std::string& model : options_.models) {
      Candidate candidate;
      candidate.model = model;
      candidate.single_lobe = model_info(model).terms.size() == 1;
      candidates_.push_back(std::move(candidate));
    }
  }

  ModelChoice run() {
    const auto begin = std::chrono::steady_clock::now();
    const std::vector<std::uint8_t> keep = thinned(sample_count(*observations_));
    const bool all = std::find(keep.begin(), keep.end(), 0) == keep.end();
    part_ = all ? observations_ : copied(*observations_, keep);
    folds_ = incidence_folds(*part_, options_.max_folds);
    samples_ = gather(*part_, std::vector<std::uint8_t>(folds_.of_sample.size(), 1), folds_.of_sample);
    noise_ = noise_level(*part_, samples_);
    fit_all();
    cross_validate();
    add_criteria();
    rank();
    ModelChoice out;
    conclude(out);
    out.folds = std::move(folds_);
    out.folds.of_sample.clear();
    out.noise = noise_;
    out.margin = options_.margin;
    out.n_samples = samples_.size();
    out.candidates = std::move(candidates_);
    out.choice_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return out;
  }

 private:
  std::size_t total() const { return candidates_.size() * (1 + folds_.count); }

  void fit_all() {
    for_each_index(candidates_.size(), options_.jobs, [&](std::size_t m) {
      Candidate& candidate = candidates_[m];
      FitOptions how = options_.fit;
      how.model = candidate.model;
      Attempt done = attempt(*observations_, options_, std::move(how), total());
      candidate.ranked = done.refused.empty();
      candidate.reason = std::move(done.refused);
      candidate.fit = std::move(done.fit);
    });
    for (std::size_t m = 0; m < candidates_.size(); ++m) {
      Candidate& candidate = candidates_[m];
      if (!candidate.ranked) continue;
      candidate.free_parameters = static_cast<std::size_t>(std::count_if(candidate.fit.parameters.begin(), candidate.fit.parameters.end(),
                                                                         [](const auto& p) { return p.kind != IntervalKind::fixed; }));
      candidate.free_parameters += static_cast<std::size_t>(std::count_if(candidate.fit.nuisance.begin(), candidate.fit.nuisance.end(),
                                                                          [](const auto& p) { return p.kind == IntervalKind::interval; }));
      add_note(candidate.reason, unidentified(candidate.fit));
      const std::string same = same_as(candidate, {candidates_.begin(), candidates_.begin() + static_cast<std::ptrdiff_t>(m)});
      add_note(candidate.reason, same);
      if (candidate.single_lobe && same.empty()) candidate.hint = second_lobe(candidate.fit);
    }
  }

  void cross_validate() {
    predictions_.assign(candidates_.size(), std::vector<PredictionSums>(folds_.count));
    if (folds_.count < 2) return;
    std::vector<std::shared_ptr<const Observations>> without;
    for (std::size_t fold = 0; fold < folds_.count; ++fold) {
      std::vector<std::uint8_t> keep;
      for (const std::uint8_t of_sample : folds_.of_sample) keep.push_back(of_sample != Folds::none && of_sample != fold);
      without.push_back(subset(part_, std::move(keep)));
    }
    std::vector<std::string> failed(candidates_.size() * folds_.count);
    for_each_index(failed.size(), options_.jobs, [&](std::size_t task) {
      const std::size_t m = task / folds_.count, fold = task % folds_.count;
      if (!candidates_[m].ranked) {
        if (options_.fitted) options_.fitted(total());
        return;
      }
      FitOptions how = options_.fit;
      how.model = candidates_[m].model;
      how.only_values = true;
      const Attempt done = attempt(*without[fold], options_, std::move(how), total());
      failed[task] = done.refused;
      Samples own;
      if (done.refused.empty())
        predictions_[m][fold] =
            prediction_sums(samples_for(done.fit, own), model_info(candidates_[m].model), done.fit.values, static_cast<std::uint8_t>(fold));
    });
    for (std::size_t task = 0; task < failed.size(); ++task) {
      Candidate& candidate = candidates_[task / folds_.count];
      if (failed[task].empty() || !candidate.ranked) continue;
      candidate.ranked = false;
      candidate.reason = fmt::format("without fold {} of {}: {}", task % folds_.count + 1, folds_.count, failed[task]);
    }
    for (std::size_t m = 0; m < candidates_.size(); ++m) {
      Candidate& candidate = candidates_[m];
      if (!candidate.ranked) continue;
      PredictionSums all;
      for (const PredictionSums& part : predictions_[m]) all += part;
      for (std::size_t k = 0; k < every_metric.size(); ++k) candidate.cross_validated[k] = all.error(every_metric[k]);
      const auto beyond = [](double error, double noise) { return std::sqrt(std::max(0.0, error * error - noise * noise)); };
      const auto cosine = all.relative_error(Metric::linear_cos), cube_root = all.relative_error(Metric::cbrt);
      if (!cosine || !cube_root) continue;
      candidate.relative_error = std::max(beyond(*cosine, noise_.linear_cos), 3 * beyond(*cube_root, noise_.cbrt));
      candidate.adequate = *candidate.relative_error <= options_.margin;
    }
  }

  /// The samples as this fit's model describes them: nuisance parameters taken out, in `own`.
  const Samples& samples_for(const FitResult& fit, Samples& own) const {
    if (fit.nuisance.empty()) return samples_;
    own = gather(*corrected(*part_, fit.nuisance), std::vector<std::uint8_t>(folds_.of_sample.size(), 1), folds_.of_sample);
    return own;
  }

  void add_criteria() {
    std::vector<Likelihood> likelihoods(candidates_.size());
    double inflation = std::numeric_limits<double>::infinity();
    for (std::size_t m = 0; m < candidates_.size(); ++m) {
      const Candidate& candidate = candidates_[m];
      if (!candidate.ranked) continue;
      Samples own;
      likelihoods[m] = likelihood(samples_for(candidate.fit, own), model_info(candidate.model), candidate.fit.values,
                                  options_.fit.metric.value_or(Metric::linear));
      const double dof = static_cast<double>(likelihoods[m].n) - static_cast<double>(candidate.free_parameters);
      if (dof >= 1) inflation = std::min(inflation, likelihoods[m].minus_two_log / dof);
    }
    for (std::size_t m = 0; m < candidates_.size(); ++m) {
      Candidate& candidate = candidates_[m];
      if (!candidate.ranked || likelihoods[m].n == 0) continue;
      const bool weighted = likelihoods[m].weighted;
      const double base = weighted ? likelihoods[m].minus_two_log / std::max(1.0, inflation) : likelihoods[m].minus_two_log;
      const double k = static_cast<double>(candidate.free_parameters) + (weighted ? 0 : 1);  // the unknown variance is one more
      const auto n = static_cast<double>(likelihoods[m].n);
      if (n - k - 1 > 0) candidate.aicc = base + 2 * k + 2 * k * (k + 1) / (n - k - 1);
      candidate.bic = base + k * std::log(n);
    }
  }

  void rank() {
    for (std::size_t metric = 0; metric < every_metric.size(); ++metric) {
      std::vector<double> errors;
      for (const Candidate& candidate : candidates_)
        if (candidate.ranked && candidate.cross_validated[metric]) errors.push_back(*candidate.cross_validated[metric]);
      for (Candidate& candidate : candidates_) {
        if (!candidate.ranked || !candidate.cross_validated[metric]) continue;
        const double limit = *candidate.cross_validated[metric] * (1 - tie);
        candidate.rank[metric] =
            1 + static_cast<std::size_t>(std::count_if(errors.begin(), errors.end(), [&](double e) { return e < limit; }));
      }
    }
    std::array<double, ranking_metrics.size()> least{};
    for (std::size_t r = 0; r < least.size(); ++r) {
      least[r] = std::numeric_limits<double>::infinity();
      for (const Candidate& candidate : candidates_)
        least[r] = std::min(least[r], candidate.cross_validated[index_of(ranking_metrics[r])].value_or(least[r]));
    }
    for (Candidate& candidate : candidates_) {
      double log_score = 0;
      for (std::size_t r = 0; r < least.size(); ++r) {
        const auto error = candidate.cross_validated[index_of(ranking_metrics[r])];
        log_score += error && least[r] > 0 ? std::log(*error / least[r]) : error && *error == 0 ? 0 : std::nan("");
      }
      if (std::isfinite(log_score)) candidate.score = std::exp(log_score / static_cast<double>(least.size()));
    }
    // Without cross-validation, by Akaike's criterion; ties by the number of parameters, then as they were given.
    order_.resize(candidates_.size());
    for (std::size_t m = 0; m < order_.size(); ++m) order_[m] = m;
    const auto key = [&](std::size_t m) {
      const Candidate& c = candidates_[m];
      const double worst = std::numeric_limits<double>::infinity();
      const double value = c.score ? std::round(std::log(*c.score) / tie) : folds_.count < 2 ? c.aicc.value_or(worst) : worst;
      return std::tuple(!c.ranked, value, c.free_parameters);
    };
    std::stable_sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  }

  /// Whether model m predicts as well as the best, to one standard error of the difference over the folds, under every ranking metric.
  bool as_good_as(std::size_t m, std::size_t best) const {
    for (const Metric metric : ranking_metrics) {
      const std::size_t k = index_of(metric);
      double n = 0, mean = 0, squares = 0;
      for (std::size_t fold = 0; fold < folds_.count; ++fold) {
        const PredictionSums &a = predictions_[m][fold], &b = predictions_[best][fold];
        if (!(a.count[k] > 0) || !(b.count[k] > 0) || a.undefined[k]) return false;
        const double difference = a.square[k] / a.count[k] - b.square[k] / b.count[k];
        n += 1;
        const double from_old = difference - mean;
        mean += from_old / n;
        squares += from_old * (difference - mean);
      }
      const double least = *candidates_[best].cross_validated[k];
      const double standard_error = n > 1 ? std::sqrt(squares / (n - 1) / n) : 0;
      if (mean > standard_error + tie * least * least) return false;
    }
    return true;
  }

  void conclude(ModelChoice& out) {
    const Candidate* best_single = nullptr;
    for (const std::size_t m : order_) {
      const Candidate& candidate = candidates_[m];
      if (!candidate.ranked) continue;
      if (!out.best) out.best = candidate.model;
      out.any_adequate = out.any_adequate || candidate.adequate;
      out.single_lobe_adequate = out.single_lobe_adequate || (candidate.single_lobe && candidate.adequate);
      if (!best_single && candidate.single_lobe) best_single = &candidate;
    }
    if (out.best && folds_.count > 1 && candidates_[order_.front()].score) {
      std::size_t simplest = order_.front();
      for (const std::size_t m : order_)
        if (candidates_[m].score && candidates_[m].free_parameters < candidates_[simplest].free_parameters && as_good_as(m, order_.front()))
          simplest = m;
      out.simplest = candidates_[simplest].model;
    }
    out.verdict = verdict(out, best_single);
    std::vector<Candidate> sorted;
    for (const std::size_t m : order_) sorted.push_back(std::move(candidates_[m]));
    candidates_ = std::move(sorted);
  }

  std::string verdict(const ModelChoice& out, const Candidate* best_single) const {
    if (!out.best) return "no model could be fitted";
    if (folds_.count < 2) return "there are too few samples to leave any out: adequacy cannot be judged";
    const std::string noise = noise_.source == NoiseLevel::Source::unknown
                                  ? " (the data state no uncertainty and hold no repeats: noise counts as misfit)"
                                  : " beyond the noise";
    const auto figure = [&](const Candidate& c) {
      return fmt::format("{} misses left-out samples by {:.3g} %", c.model, 100 * c.relative_error.value_or(std::nan("")));
    };
    std::string text;
    if (out.single_lobe_adequate) {
      const auto first = std::find_if(order_.begin(), order_.end(), [&](std::size_t m) { return candidates_[m].adequate; });
      text = figure(candidates_[*first]) + noise + fmt::format(": adequate, the margin is {:.3g} %", 100 * options_.margin);
    } else {
      if (best_single) text = "no adequate single-lobe model: the best, " + figure(*best_single) + noise;
      const auto sum = std::find_if(order_.begin(), order_.end(), [&](std::size_t m) { return candidates_[m].adequate; });
      if (sum != order_.end())
        add_note(text, figure(candidates_[*sum]) + ": adequate");
      else if (!best_single || !candidates_[order_.front()].single_lobe)
        add_note(text, "no adequate model: the best, " + figure(candidates_[order_.front()]) + noise);
      text += fmt::format("; the margin is {:.3g} %", 100 * options_.margin);
    }
    return text;
  }

  std::shared_ptr<const Observations> observations_;
  const ChoiceOptions& options_;
  Folds folds_;
  std::shared_ptr<const Observations> part_;  ///< what is cross-validated: all samples, or of many an even part
  Samples samples_;
  NoiseLevel noise_;
  std::vector<Candidate> candidates_;
  std::vector<std::vector<PredictionSums>> predictions_;  ///< [model][fold]
  std::vector<std::size_t> order_;                        ///< candidates, the best first
};

}  // namespace

ModelChoice choose_model(std::shared_ptr<const Observations> observations, const ChoiceOptions& options) {
  return Choice(std::move(observations), options).run();
}

}  // namespace gonio::fitting
