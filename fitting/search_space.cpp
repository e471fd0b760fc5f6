// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/search_space.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace gonio::fitting {
namespace {

bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

/// Whether a lobe falls faster from its peak when its first nonlinear parameter grows, judged on the middle half of the scan axis.
bool narrows(const ModelInfo& model) {
  const auto values_at = [&](double part) {
    std::vector<double> theta;
    for (std::size_t j = model.linear_count; j < model.parameters.size(); ++j) {
      const Parameter& p = model.parameters[j];
      if (j > model.linear_count)
        theta.push_back(p.example);
      else if (p.axis == Parameter::Axis::logarithmic)
        theta.push_back(p.scan_low * std::pow(p.scan_high / p.scan_low, part));
      else
        theta.push_back(p.scan_low + (p.scan_high - p.scan_low) * part);
    }
    return theta;
  };
  // Ten degrees off the mirror direction, at an incidence of 20°.
  const std::vector<LobeGeometry> geometry{lobe_geometry({degrees(20), degrees(0), degrees(20), degrees(180)}),
                                           lobe_geometry({degrees(20), degrees(0), degrees(30), degrees(180)})};
  const auto fall = [&](double part) {
    const std::vector<double> theta = values_at(part);
    std::vector<double> columns(2 * model.linear_count);
    model.basis(geometry, theta.data(), columns.data(), 2);
    return columns[3] / columns[2];  // the second basis function is the lobe's
  };
  return fall(0.75) < fall(0.25);
}

}  // namespace

double SearchAxis::coordinate(double value) const { return logarithmic ? std::log(value) : value; }
double SearchAxis::value(double coordinate) const { return logarithmic ? std::exp(coordinate) : coordinate; }

SearchSpace::SearchSpace(const ModelKernel& kernel, const std::vector<Wanted>& wanted, const std::vector<bool>& alike) : kernel_(&kernel) {
  for (std::size_t j = 0; j < kernel.nonlinear; ++j) {
    const Parameter& parameter = kernel.info->parameters[kernel.linear + j];
    held_.push_back(wanted[j].held);
    if (!std::isnan(wanted[j].held)) continue;
    SearchAxis axis;
    axis.parameter = j;
    axis.logarithmic = parameter.axis == Parameter::Axis::logarithmic;
    double low = parameter.lower, high = parameter.upper, scan_low = parameter.scan_low, scan_high = parameter.scan_high;
    if (axis.logarithmic && !(low > 0)) low = scan_low;
    if (!std::isnan(wanted[j].lower)) scan_low = std::max(low, wanted[j].lower), low = scan_low;
    if (!std::isnan(wanted[j].upper)) scan_high = high = wanted[j].upper;
    axis.low = axis.coordinate(low), axis.high = axis.coordinate(high);
    axis.scan_low = axis.coordinate(std::clamp(scan_low, low, high)), axis.scan_high = axis.coordinate(std::clamp(scan_high, low, high));
    axes_.push_back(axis);
  }
  const auto& terms = kernel.info->terms;
  std::vector<bool> grouped(terms.size());
  for (std::size_t t = 0; t < terms.size(); ++t) {
    const std::size_t nonlinear = terms[t].model->nonlinear_count();
    const auto like = [&](std::size_t other) {
      if (terms[other].model != terms[t].model || !alike[other]) return false;
      for (std::size_t j = 0; j < nonlinear; ++j) {
        const Wanted &a = wanted[terms[t].nonlinear + j], &b = wanted[terms[other].nonlinear + j];
        if (!std::isnan(a.held) || !std::isnan(b.held) || !same(a.lower, b.lower) || !same(a.upper, b.upper)) return false;
      }
      return true;
    };
    if (grouped[t] || nonlinear == 0 || !like(t)) continue;
    Group group;
    for (std::size_t other = t; other < terms.size(); ++other)
      if (like(other)) group.terms.push_back(other), grouped[other] = true;
    if (group.terms.size() < 2) continue;
    group.linear = terms[t].model->linear_count - 1;
    group.nonlinear = nonlinear;
    group.ascending = narrows(*terms[t].model);
    groups_.push_back(std::move(group));
  }
}

std::vector<double> SearchSpace::theta(std::span<const double> z) const {
  std::vector<double> out = held_;
  for (std::size_t a = 0; a < axes_.size(); ++a) out[axes_[a].parameter] = axes_[a].value(z[a]);
  return out;
}

std::vector<double> SearchSpace::coordinates(std::span<const double> theta) const {
  std::vector<double> out;
  for (const SearchAxis& axis : axes_) out.push_back(axis.coordinate(theta[axis.parameter]));
  return out;
}

bool SearchSpace::ordered(std::span<const double> theta) const {
  for (const Group& group : groups_)
    for (std::size_t k = 1; k < group.terms.size(); ++k) {
      const double before = theta[kernel_->info->terms[group.terms[k - 1]].nonlinear];
      const double after = theta[kernel_->info->terms[group.terms[k]].nonlinear];
      if (group.ascending ? after < before : after > before) return false;
    }
  return true;
}

void SearchSpace::order(std::vector<double>& theta, std::vector<std::vector<double>>& linear) const {
  if (ordered(theta)) return;
  const auto& terms = kernel_->info->terms;
  // The lobe of the first term stands behind the diffuse part.
  const auto lobe = [&](std::size_t term) { return terms[term].linear + (terms[term].first_basis == 0 ? 1 : 0); };
  const std::vector<double> old_theta = theta;
  const std::vector<std::vector<double>> old_linear = linear;
  for (const Group& group : groups_) {
    std::vector<std::size_t> from = group.terms;
    std::stable_sort(from.begin(), from.end(), [&](std::size_t a, std::size_t b) {
      const double at_a = old_theta[terms[a].nonlinear], at_b = old_theta[terms[b].nonlinear];
      return group.ascending ? at_a < at_b : at_a > at_b;
    });
    for (std::size_t k = 0; k < from.size(); ++k) {
      const std::size_t to = group.terms[k];
      for (std::size_t j = 0; j < group.nonlinear; ++j) theta[terms[to].nonlinear + j] = old_theta[terms[from[k]].nonlinear + j];
      for (std::size_t c = 0; c < linear.size(); ++c)
        for (std::size_t j = 0; j < group.linear; ++j) linear[c][lobe(to) + j] = old_linear[c][lobe(from[k]) + j];
    }
  }
}

}  // namespace gonio::fitting
