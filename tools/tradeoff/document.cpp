// SPDX-License-Identifier: BSD-3-Clause
// The measured points as JSON and as CSV: the same records.
#include <fmt/format.h>

#include "tools/tradeoff/tradeoff.hpp"

namespace gonio::tools::tradeoff {
namespace {

Json line(const Line& value) { return Json::object({{"value", value.value}, {"label", value.label}}); }

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

}  // namespace

Json document(std::string_view topic, bool quick, const Measured& measured, Json context) {
  Json panels = Json::array(), points = Json::array();
  for (const Panel& panel : measured.panels) {
    Json floors = Json::array();
    for (const Line& floor : panel.error_floors) floors.push_back(line(floor));
    panels.push_back(Json::object({{"name", panel.name},
                                   {"drawn", panel.drawn},
                                   {"error_floors", std::move(floors)},
                                   {measured.by_size ? "size_limit_bytes" : "time_limit_s", line(panel.limit)}}));
  }
  for (const Point& point : measured.points)
    points.push_back(Json::object(
        {{"panel", point.panel},
         {"method", point.method},
         {"setting", point.setting},
         {"time_s",
          Json::object(
              {{"median", point.time.median_s}, {"least", point.time.least_s}, {"most", point.time.most_s}, {"runs", point.time.runs}})},
         {"bytes", point.bytes ? Json(*point.bytes) : Json()},
         {"error", point.error ? Json(*point.error) : Json()},
         {"worst_at", point.worst_at},
         {"on_front", point.on_front}}));
  return Json::object({{"context", std::move(context)},
                       {"topic", topic},
                       {"quick", quick},
                       {"title", measured.title},
                       {"time_of", measured.time_of},
                       {"error_of", measured.error_of},
                       {"panels", std::move(panels)},
                       {"points", std::move(points)},
                       {"advice", advice(measured)}});
}

std::string csv(const Measured& measured) {
  std::string out = "panel,method,setting,time_median_s,time_least_s,time_most_s,runs,bytes,error,worst_at,on_front\n";
  for (const Point& point : measured.points)
    out += fmt::format("{},{},{},{},{},{},{},{},{},{},{}\n", quoted(point.panel), quoted(point.method), quoted(point.setting),
                       point.time.median_s, point.time.least_s, point.time.most_s, point.time.runs,
                       point.bytes ? fmt::format("{}", *point.bytes) : "", point.error ? fmt::format("{}", *point.error) : "nan",
                       quoted(point.worst_at), point.on_front ? 1 : 0);
  return out;
}

}  // namespace gonio::tools::tradeoff
