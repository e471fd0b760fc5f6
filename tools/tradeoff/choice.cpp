// SPDX-License-Identifier: BSD-3-Clause
// What to choose: fronts and the paragraph of advice, from the points alone.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "tools/tradeoff/tradeoff.hpp"

namespace gonio::tools::tradeoff {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
/// Times closer than this are the same: two runs of one program differ by as much.
constexpr double same_time = 0.02;

double error_of(const Point& point) { return point.error.value_or(infinite); }

/// A method at a setting over all panels that have it.
struct Choice {
  std::string method, setting;
  double worst_error = 0, worst_cost = 0, total_cost = 0;
  std::string worst_panel;
  std::size_t panels = 0;
};

std::vector<Choice> choices(const std::vector<Point>& points, bool by_size) {
  std::map<std::pair<std::string, std::string>, Choice> by_setting;
  for (const Point& point : points) {
    Choice& choice = by_setting[{point.method, point.setting}];
    choice.method = point.method, choice.setting = point.setting;
    if (choice.panels++ == 0 || error_of(point) > choice.worst_error)
      choice.worst_error = error_of(point), choice.worst_panel = point.panel;
    choice.worst_cost = std::max(choice.worst_cost, cost(point, by_size));
    choice.total_cost += cost(point, by_size);
  }
  std::vector<Choice> out;
  for (auto& [key, choice] : by_setting) out.push_back(std::move(choice));
  return out;
}

std::string cost_text(const Measured& measured, double cost) {
  return fmt::format("{:.3g} {}", cost / measured.time_unit_s, measured.time_unit);
}

std::string named(const Choice& choice) { return choice.setting.empty() ? choice.method : choice.method + ", " + choice.setting; }

}  // namespace

double cost(const Point& point, bool by_size) { return by_size ? point.bytes.value_or(infinite) : point.time.median_s; }

void mark_front(std::vector<Point>& points, bool by_size) {
  for (Point& point : points) {
    point.on_front = point.error.has_value();
    for (const Point& other : points) {
      if (&other == &point || other.panel != point.panel) continue;
      const double price = cost(other, by_size), error = error_of(other);
      const bool no_worse = price <= cost(point, by_size) * (1 + same_time) && error <= error_of(point);
      const bool better = price < cost(point, by_size) * (1 - same_time) || error < error_of(point);
      if (no_worse && better) point.on_front = false;
    }
  }
}

std::string advice(const Measured& measured) {
  std::set<std::string> panels;
  for (const Point& point : measured.points) panels.insert(point.panel);
  const std::vector<Choice> all = choices(measured.points, measured.by_size);
  const bool several = panels.size() > 1;
  std::string text;
  const Choice* last = nullptr;
  for (const double target : measured.targets) {
    const Choice* best = nullptr;
    for (const Choice& choice : all)
      if (choice.panels == panels.size() && choice.worst_error <= target && (!best || choice.total_cost < best->total_cost)) best = &choice;
    if (!best)
      text += fmt::format("No setting tried is within {:g}{}. ", target, several ? " in every panel" : "");
    else if (best == last)
      text += fmt::format("The same serves for {:g}. ", target);
    else
      text += fmt::format("For an error of at most {:g}{} choose {}: {}{} (worst error {:.2g}{}). ", target,
                          several ? " in every panel" : "", named(*best), several ? "at most " : "", cost_text(measured, best->worst_cost),
                          best->worst_error, several ? ", at " + best->worst_panel : "");
    if (best) last = best;
  }
  const double loosest = measured.targets.empty() ? 0 : *std::max_element(measured.targets.begin(), measured.targets.end());
  std::map<std::string, const Choice*> best_of_method;
  for (const Choice& choice : all) {
    const Choice*& best = best_of_method[choice.method];
    if (!best || choice.worst_error < best->worst_error) best = &choice;
  }
  for (const auto& [method, best] : best_of_method)
    if (best->worst_error > loosest)
      text +=
          fmt::format("At every setting tried {} misses {:g}: {} at {}. ", method, loosest,
                      std::isfinite(best->worst_error) ? fmt::format("still {:.2g}", best->worst_error) : "no number", best->worst_panel);
  for (const std::string& remark : measured.remarks) text += remark + " ";
  if (!text.empty()) text.pop_back();
  return text;
}

}  // namespace gonio::tools::tradeoff
