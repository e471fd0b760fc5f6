// SPDX-License-Identifier: BSD-3-Clause
// What accuracy costs in time: settings measured against a known truth, and what to choose among them.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "data-schemas/json.hpp"
#include "tools/tradeoff/timing.hpp"

namespace gonio::tools::tradeoff {

/// The one seed of everything random in the topics.
inline constexpr std::uint64_t seed = 20260701;

/// One setting of one method, measured.
struct Point {
  std::string panel, method, setting;
  Timing time;
  /// Relative error, the worst over the cases of the panel; none where the result was not a number.
  std::optional<double> error;
  std::string worst_at;         ///< the case with that error
  std::optional<double> bytes;  ///< of the table or the file, where the setting makes one
  bool on_front = false;        ///< no other point of the panel is both cheaper and nearer the truth
};

/// A labelled line of a plot.
struct Line {
  double value = 0;
  std::string label;
};

/// Points that answer the same question, drawn together.
struct Panel {
  std::string name;
  std::vector<Line> error_floors;  ///< no method of a kind can be nearer the truth than this; relative
  Line limit;                      ///< no method can be cheaper than this; seconds, or bytes if the topic goes by them
  bool drawn = true;               ///< whether the plot shows it; the table shows all
};

struct Measured {
  std::string title, time_of, error_of;  ///< headings: of the plot, the time axis, the error axis
  double time_unit_s = 1;                ///< the plot's unit of time; of bytes if `by_size`
  std::string time_unit;
  bool by_size = false;         ///< plot, fronts and advice are of bytes against error, not of time; every point has its bytes
  std::vector<double> targets;  ///< errors for which the text names the cheapest setting
  std::vector<Panel> panels;
  std::vector<Point> points;
  std::vector<std::string> remarks;  ///< sentences that the points cannot say by themselves
};

/// How much to measure, and where to tell about it.
struct Effort {
  bool quick = false;                                                ///< the whole topic in less than 10 s
  std::function<void(double part, std::string_view what)> progress;  ///< part of the work done, 0 to 1
};

/// One question of accuracy against time. A topic is one file and one line in the list of topics.cpp.
struct Topic {
  std::string_view name, summary;
  Measured (*measure)(const Effort& effort);
};
const std::vector<Topic>& topics();

Measured measure_albedo(const Effort& effort);
Measured measure_fit(const Effort& effort);
Measured measure_precision(const Effort& effort);
Measured measure_table(const Effort& effort);
Measured measure_export(const Effort& effort);

/// What a point costs: the median of its time [s], or its bytes.
double cost(const Point& point, bool by_size);
/// Marks the points that no other point of their panel beats in both cost and error.
void mark_front(std::vector<Point>& points, bool by_size = false);
/// One paragraph: the cheapest setting for each target that holds in every panel, what never gets there, and the topic's remarks.
std::string advice(const Measured& measured);
/// The document of `gonio tradeoff` (data-schemas/tradeoff.schema.json) and its points as CSV.
Json document(std::string_view topic, bool quick, const Measured& measured, Json context);
std::string csv(const Measured& measured);
/// The script by which gnuplot draws the drawn panels: log-log, one marker a setting, fronts joined, floor and limit labelled.
/// `terminal` is gnuplot's terminal with its font; the size follows from the number of panels.
std::string plot_script(const Measured& measured, const std::string& terminal, const std::string& output);

}  // namespace gonio::tools::tradeoff
