// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/nuisance.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "brdf/error.hpp"
#include "fitting/corrected.hpp"
#include "fitting/distributions.hpp"
#include "fitting/nuisance_rows.hpp"
#include "fitting/point_fit.hpp"
#include "fitting/shared_errors.hpp"

namespace gonio::fitting {
namespace {

constexpr int most_steps = 40;
constexpr int most_trials = 10;            // of a damping
constexpr int most_rounds = 5;             // of weights
constexpr int most_reweightings = 3;       // as in solve()
constexpr double settled = 1e-3;           // of a standard uncertainty
constexpr double settled_round = 0.03;     // of one, from round to round of the weights
constexpr double at_the_bound = 1e-6;      // of the bound: no step ends nearer to it than in it
constexpr double part_undetermined = 0.1;  // of a parameter in a direction the data do not determine (numerics D.5)
constexpr double dependent = 1e-9;         // of the largest: a column that the others nearly make up
constexpr double significant = 0.01;       // probability of a χ² that widens intervals, as in estimate()
constexpr double infinity = std::numeric_limits<double>::infinity();

using Vector = Eigen::VectorXd;
using Dense = Eigen::MatrixXd;

Eigen::Index index(std::size_t k) { return static_cast<Eigen::Index>(k); }

/// Columns of M and E, and the residual, with what the model's own parameters can take up taken out of them.
struct Reduced {
  Dense slopes, components;
  Vector residual;
};

class Estimation {
 public:
  Estimation(Terms& terms, const Observations& observations, const SolveOptions& how, const NuisanceOptions& asked,
             const std::vector<CorrelatedComponent>& components)
      : terms_(terms),
        observations_(observations),
        how_(how),
        rows_(terms, observations, asked, components),
        space_(terms.kernel, how.nonlinear, how.alike),
        m_(rows_.axes().size(), 0.0),
        active_(m_.size(), true) {
    if (!asked.components) components_ = changes_by(terms, components);
  }

  NuisanceFit run(const Weigh& weigh) {
    const std::vector<ChannelTerms> before = terms_.channel;
    NuisanceFit out;
    for (int round = 0; round < most_rounds; ++round) {
      const std::vector<double> last = m_;
      if (round > 0) terms_.channel = before;
      const auto seen = corrected(observations_, parameters());
      out.weighting = weigh(*seen);
      if (!estimate()) break;
      double change = 0;
      for (std::size_t k = 0; k < m_.size(); ++k)
        if (active_[k]) change = std::max(change, std::abs(m_[k] - last[k]) / sigma(k));
      if (change < settled_round) break;
    }
    out.parameters = parameters();
    out.changes = changes();
    for (std::size_t k = 0; k < m_.size(); ++k) (rows_.axes()[k].with_prior ? out.with_prior : out.free) += active_[k];
    return out;
  }

 private:
  const ProfilePoint& model() const { return fit_->last()->point; }

  /// The cost with the prior; the terms stand at m.
  double cost_at(const std::vector<double>& m, bool global = false) {
    rows_.set(m);
    if (!(*fit_)(global)) return infinity;
    double cost = model().cost;
    for (std::size_t k = 0; k < m.size(); ++k)
      if (rows_.axes()[k].with_prior) cost += scale_ * m[k] * m[k];
    return cost;
  }

  /// Variance of a reading with weight 1.
  double scale() const {
    double values = 0, fitted = static_cast<double>(space_.dimension());
    for (const ChannelTerms& channel : terms_.channel) values += static_cast<double>(channel.count);
    for (const LinearLimits& limits : how_.limits)
      fitted += static_cast<double>(std::count_if(limits.held.begin(), limits.held.end(), [](double held) { return std::isnan(held); }));
    const double cost = model().cost, dof = std::max(1.0, values - fitted);
    const bool misses = terms_.pure_error && chi2_upper_tail(cost, dof) < significant;
    return (terms_.weighted || terms_.pure_error) && !misses ? 1 : std::max(cost / dof, std::numeric_limits<double>::min());
  }

  Reduced reduced() {
    slopes_ = std::make_shared<NuisanceRows::Slopes>(rows_.slopes(m_, model().linear(), model().theta));
    const Transform& transform = terms_.transform;
    std::vector<Change> columns;
    columns.push_back([this](std::size_t c, std::size_t row, double f) {
      return terms_.transform.value(f, terms_.geometry[row].cos_i) - terms_.channel[c].target[row];
    });
    for (std::size_t k = 0; k < m_.size(); ++k)
      columns.push_back([this, k, &transform](std::size_t c, std::size_t row, double f) {
        return transform.slope(f, terms_.geometry[row].cos_i) * (*slopes_)[k][c][row];
      });
    columns.insert(columns.end(), components_.begin(), components_.end());
    const Linearisation at = linearise(terms_, space_, how_.limits, model().linear(), model().theta, columns, how_.threads);
    // Rows below the linear parameters, of all channels; then the nonlinear parameters are taken out.
    const std::size_t width = at.free + at.right;
    Dense all(index(at.r.size() * width), index(width));
    for (std::size_t c = 0; c < at.r.size(); ++c)
      for (std::size_t i = 0; i < width; ++i)
        for (std::size_t j = 0; j < width; ++j)
          all(index(c * width + i), index(j)) = at.r[c](at.columns[c].size() + i, at.columns[c].size() + j);
    Dense right = all.rightCols(index(at.right));
    if (at.free > 0) {
      Eigen::ColPivHouseholderQR<Dense> qr(all.leftCols(index(at.free)));
      qr.setThreshold(dependent);
      const Dense turned = qr.householderQ().adjoint() * right;
      right = turned.bottomRows(turned.rows() - qr.rank());
    }
    return {right.middleCols(1, index(m_.size())), right.rightCols(index(components_.size())), right.col(0)};
  }

  /// The normal matrix of the active parameters, prior included, in units of their bounds.
  Dense normal(const Reduced& at) const {
    Dense out = at.slopes.transpose() * at.slopes;
    for (std::size_t k = 0; k < m_.size(); ++k) {
      if (rows_.axes()[k].with_prior) out(index(k), index(k)) += scale_;
      if (active_[k]) continue;
      out.row(index(k)).setZero();
      out.col(index(k)).setZero();
    }
    return bounds().asDiagonal() * out * bounds().asDiagonal();
  }
  Vector bounds() const {
    Vector out(index(m_.size()));
    for (std::size_t k = 0; k < m_.size(); ++k) out[index(k)] = rows_.axes()[k].bound;
    return out;
  }

  /// Gauss-Newton from m_ over the active parameters. False if there is no solution.
  bool descend() {
    double cost = cost_at(m_), damping = 0;
    if (!std::isfinite(cost)) return false;
    for (int step = 0; step < most_steps; ++step) {
      reduced_ = reduced();
      Vector gradient = at_bounds(reduced_.slopes.transpose() * reduced_.residual);
      eigen_.compute(normal(reduced_));
      const Vector along = eigen_.eigenvectors().transpose() * gradient;
      bool lower = false, still = false;
      for (int trial = 0; trial < most_trials && !lower && !still; ++trial) {
        Vector part = Vector::Zero(along.size());
        for (Eigen::Index i = 0; i < part.size(); ++i)
          if (determined(i)) part[i] = -along[i] / (eigen_.eigenvalues()[i] * (1 + damping));
        const Vector move = bounds().cwiseProduct(eigen_.eigenvectors() * part);
        std::vector<double> next = m_;
        still = true;
        for (std::size_t k = 0; k < m_.size(); ++k) {
          const double bound = rows_.axes()[k].bound;
          next[k] = std::clamp(m_[k] + move[index(k)], -bound, bound);
          if (std::abs(next[k]) > (1 - at_the_bound) * bound) next[k] = std::copysign(bound, next[k]);
          still = still && std::abs(next[k] - m_[k]) <= settled * sigma(k);
        }
        if (still) break;
        const double there = cost_at(next);
        lower = there < cost;
        if (lower) m_ = next, cost = there;
        damping = lower ? damping / 10 : std::max(1e-2, 10 * damping);
      }
      if (!lower) break;
    }
    return std::isfinite(cost_at(m_));
  }

  /// Half the gradient in units of the bounds, prior included; 0 for what is held, or leans against a bound.
  Vector at_bounds(const Vector& data) const {
    Vector out = Vector::Zero(data.size());
    for (std::size_t k = 0; k < m_.size(); ++k) {
      const NuisanceAxis& axis = rows_.axes()[k];
      const double slope = data[index(k)] + (axis.with_prior ? scale_ * m_[k] : 0);
      if (active_[k] && !(std::abs(m_[k]) >= axis.bound && slope * m_[k] < 0)) out[index(k)] = slope * axis.bound;
    }
    return out;
  }

  bool determined(Eigen::Index direction) const { return eigen_.eigenvalues()[direction] > scale_; }

  /// Covariance of m, 0 for what is not active.
  Dense covariance() const {
    Dense out = Dense::Zero(index(m_.size()), index(m_.size()));
    for (Eigen::Index i = 0; i < out.rows(); ++i)
      if (determined(i)) out += scale_ / eigen_.eigenvalues()[i] * eigen_.eigenvectors().col(i) * eigen_.eigenvectors().col(i).transpose();
    return bounds().asDiagonal() * out * bounds().asDiagonal();
  }
  double sigma(std::size_t k) const {
    const double variance = covariance()(index(k), index(k));
    return variance > 0 ? std::sqrt(variance) : rows_.axes()[k].bound;
  }

  /// m at its minimum, what the data do not determine held at 0. False if there is no solution.
  bool estimate() {
    fit_ = std::make_unique<PointFit>(terms_, how_);
    std::fill(active_.begin(), active_.end(), true);
    if (!std::isfinite(cost_at(m_, true))) return false;
    for (int round = 0; round <= most_reweightings; ++round) {
      do {
        scale_ = scale();
        if (!descend()) return false;
        reduced_ = reduced();
        eigen_.compute(normal(reduced_));
        solved_ = true;
      } while (hold_undetermined());
      if (round == most_reweightings || !reweight(terms_, model().linear(), model().theta)) break;
    }
    return true;
  }

  /// Whether there was anything to hold.
  bool hold_undetermined() {
    bool found = false;
    for (std::size_t k = 0; k < m_.size(); ++k) {
      if (!active_[k]) continue;
      double part = 0;
      for (Eigen::Index i = 0; i < eigen_.eigenvalues().size(); ++i)
        if (!determined(i)) part += std::pow(eigen_.eigenvectors()(index(k), i), 2);
      if (part <= part_undetermined * part_undetermined) continue;
      active_[k] = false, m_[k] = 0;
      found = true;
    }
    return found;
  }

  /// How far one standard uncertainty of every component that is not estimated moves m.
  Dense moves() const {
    Dense out = Dense::Zero(index(m_.size()), index(components_.size()));
    if (components_.empty()) return out;
    const Vector unit = bounds();
    for (Eigen::Index i = 0; i < index(m_.size()); ++i)
      if (determined(i)) {
        const Vector direction = unit.cwiseProduct(eigen_.eigenvectors().col(i));
        out += direction * (direction.transpose() * reduced_.slopes.transpose() * reduced_.components) / eigen_.eigenvalues()[i];
      }
    return out;
  }

  bool at_bound(std::size_t k) const { return std::abs(m_[k]) >= rows_.axes()[k].bound; }

  std::vector<NuisanceParameter> parameters() const {
    std::vector<NuisanceParameter> out;
    const Dense own = solved_ ? covariance() : Dense(), more = solved_ ? moves() : Dense();
    const double q = terms_.weighted || terms_.pure_error ? normal_upper_quantile((1 - how_.confidence) / 2)
                                                          : student_two_sided_quantile(how_.confidence, dof());
    for (std::size_t k = 0; k < m_.size(); ++k) {
      const NuisanceAxis& axis = rows_.axes()[k];
      NuisanceParameter p;
      p.name = axis.name;
      p.unit = axis.with_prior ? "1" : "deg";
      p.value = m_[k] * axis.unit;
      p.bound = axis.bound * axis.unit;
      if (axis.with_prior) p.prior = axis.unit;
      if (solved_ && active_[k] && !at_bound(k)) {
        const double shared = components_.empty() ? 0 : more.row(index(k)).squaredNorm();
        p.sigma = axis.unit * std::sqrt(own(index(k), index(k)) + shared);
        p.low = p.value - q * *p.sigma, p.high = p.value + q * *p.sigma;
        p.kind = IntervalKind::interval;
      }
      out.push_back(std::move(p));
    }
    return out;
  }

  double dof() const {
    double values = 0;
    for (const ChannelTerms& channel : terms_.channel) values += static_cast<double>(channel.count);
    return std::max(1.0, values - static_cast<double>(m_.size() + space_.dimension() + terms_.kernel.linear * terms_.channel.size()));
  }

  std::vector<Change> changes() const {
    if (!solved_) return components_;
    const auto by_model = [this](const Vector& m) -> Change {
      return [&terms = terms_, slopes = slopes_, m](std::size_t c, std::size_t row, double f) {
        double change = 0;
        for (Eigen::Index k = 0; k < m.size(); ++k) change += m[k] * (*slopes)[static_cast<std::size_t>(k)][c][row];
        return terms.transform.slope(f, terms.geometry[row].cos_i) * change;
      };
    };
    std::vector<Change> out;
    for (Eigen::Index i = 0; i < index(m_.size()); ++i)
      if (determined(i))
        out.push_back(by_model(bounds().cwiseProduct(eigen_.eigenvectors().col(i)) * std::sqrt(scale_ / eigen_.eigenvalues()[i])));
    const Dense more = moves();
    for (std::size_t e = 0; e < components_.size(); ++e)
      out.push_back([own = components_[e], through_m = by_model(more.col(index(e)))](std::size_t c, std::size_t row, double f) {
        return own(c, row, f) - through_m(c, row, f);
      });
    return out;
  }

  Terms& terms_;
  const Observations& observations_;
  const SolveOptions& how_;
  NuisanceRows rows_;
  SearchSpace space_;
  std::vector<double> m_;
  std::vector<bool> active_;
  std::vector<Change> components_;  ///< that are not estimated
  std::unique_ptr<PointFit> fit_;
  double scale_ = 1;
  std::shared_ptr<NuisanceRows::Slopes> slopes_;
  Reduced reduced_;
  Eigen::SelfAdjointEigenSolver<Dense> eigen_;
  bool solved_ = false;
};

}  // namespace

NuisanceFit fit_nuisance(Terms& terms, const Observations& observations, const SolveOptions& how, const NuisanceOptions& asked,
                         const std::vector<CorrelatedComponent>& components, const Weigh& weigh) {
  return Estimation(terms, observations, how, asked, components).run(weigh);
}

void require_nuisance_possible(const FitOptions& options, const Observations* observations, std::size_t channels, bool shape_components) {
  if (!options.nuisance.any()) return;
  if (options.per_channel && channels > 1)
    throw Error(ErrorKind::usage,
                {"nuisance", "channels fitted one by one", "one fit of all channels, which share the sample's alignment"});
  const char* wanted = "samples with directions of their own: the sample's frame and its components are averaged away there";
  if (!observations) throw Error(ErrorKind::usage, {"nuisance", "sums over samples", wanted});
  for (std::size_t b = 0; b < observations->block_count(); ++b)
    if (observations->block(b).constant == ConstantOver::theta_h)
      throw Error(ErrorKind::input, {"nuisance", "a half/difference table", wanted});
  if (options.nuisance.components && !shape_components)
    throw Error(ErrorKind::input, {"nuisance components", "no correlated component that changes the shape",
                                   "data that state one (correlated.<name>, c_<name>); a common scale stands in u_scale"});
}

}  // namespace gonio::fitting
