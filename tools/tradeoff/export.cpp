// SPDX-License-Identifier: BSD-3-Clause
// Topic export: a BRDF in every file format and size, bytes against what a reader of the file gets.
#include <fmt/format.h>

#include <filesystem>
#include <random>
#include <system_error>
#include <utility>

#include "brdf/analytic_brdf.hpp"
#include "brdf/error.hpp"
#include "tabulated/open.hpp"
#include "tools/tradeoff/compared_pairs.hpp"

namespace gonio::tools::tradeoff {
namespace {

constexpr int timed_reads = 5;

struct Truth {
  const char* name;
  const char* model;
  std::vector<double> values;
};

const std::vector<Truth>& truths() {
  static const std::vector<Truth> list{{"Blinn-Phong, s = 20", "blinn-phong", {0.2, 0.3, 20}},
                                       {"GGX, α = 0.2", "ggx-separable", {0.2, 0.06, 0.3, 0.2}},
                                       {"Blinn-Phong, s = 1000", "blinn-phong", {0.2, 0.3, 1000}}};
  return list;
}

/// A folder for the files, gone with the object.
struct ScratchFolder {
  ScratchFolder() : path(std::filesystem::temp_directory_path() / fmt::format("gonio-tradeoff-{:08x}", std::random_device()())) {
    std::filesystem::create_directories(path);
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  std::filesystem::path path;
};

const char* name(tabulated::GridSize size) {
  return size == tabulated::GridSize::paper ? "paper" : size == tabulated::GridSize::standard ? "standard" : "fine";
}

/// Formats that write one size only have it under every name; this one is measured once.
bool same_as_before(const std::vector<Point>& points, const Point& point) {
  for (const Point& other : points)
    if (other.panel == point.panel && other.method == point.method && other.bytes == point.bytes && other.error == point.error) return true;
  return false;
}

}  // namespace

Measured measure_export(const Effort& effort) {
  using tabulated::GridSize;
  Measured out;
  out.title = "A BRDF as a file: what a reader gets against bytes (mean over pairs up to 80°, half of them near the mirror direction)";
  out.time_of = "size";
  out.error_of = "mean relative error";
  out.time_unit_s = 1e3, out.time_unit = "kB";
  out.by_size = true;
  out.targets = {0.1, 0.03, 0.01, 3e-3};
  const std::vector<GridSize> sizes =
      effort.quick ? std::vector<GridSize>{GridSize::paper} : std::vector<GridSize>{GridSize::paper, GridSize::standard, GridSize::fine};
  const std::size_t models = effort.quick ? 1 : truths().size();
  const DirectionPairs pairs = compared_pairs(effort.quick ? 2000 : 10000);
  const ScratchFolder folder;
  std::size_t number = 0;
  std::string unread;
  const auto& formats = tabulated::formats();
  for (std::size_t t = 0; t < models; ++t) {
    const Truth& truth = truths()[t];
    tabulated::Opened source;
    source.format = "model";
    source.brdf = std::make_shared<const AnalyticBrdf>(truth.model, rgb_channels(), std::vector(3, truth.values));
    source.simulated = true;
    std::vector<double> all(pairs.wi.size() * 3), wanted;
    source.brdf->eval(pairs.wi, pairs.wo, all);
    for (std::size_t k = 0; k < pairs.wi.size(); ++k) wanted.push_back(all[3 * k]);
    for (const tabulated::Format& format : formats) {
      effort.progress((static_cast<double>(t) + static_cast<double>(&format - formats.data()) / static_cast<double>(formats.size())) /
                          static_cast<double>(models),
                      fmt::format("{}, {}", truth.name, format.name));
      if (!format.write) continue;
      for (const GridSize size : sizes) {
        const std::filesystem::path file = folder.path / fmt::format("{}{}", number++, format.extension);
        Point point;
        point.panel = truth.name, point.method = format.name, point.setting = name(size);
        try {
          tabulated::WriteOptions options;
          options.size = size;
          const tabulated::ExportNotes notes = format.write(source, file, options);
          double bytes = 0;
          for (const auto& written : notes.files) bytes += static_cast<double>(std::filesystem::file_size(written));
          point.bytes = bytes;
          tabulated::ReadOptions answers;
          answers.assume = notes.assume;
          const tabulated::Opened back = tabulated::open_brdf(notes.files.front(), answers);
          if (!back.brdf) continue;
          const std::size_t channels = back.brdf->channels().size();
          std::vector<double> values(pairs.wi.size() * channels), seconds;
          // The first call may sort or index what it has opened: it is part of reading, not of a look-up.
          back.brdf->eval(pairs.wi, pairs.wo, values);
          point.time =
              time_of([&] { return back.brdf->eval(pairs.wi, pairs.wo, values), values.front(); }, pairs.wi.size(), 1e-4, timed_reads);
          const MeanError read = mean_relative_error(wanted, values, channels);
          point.error = read.mean;
          point.worst_at = fmt::format("mean of the pairs, {:.2g} % of them unknown", 100 * read.unknown);
          for (const auto& written : notes.files) std::filesystem::remove(written);
        } catch (const Error& error) {
          if (error.kind() != ErrorKind::input && error.kind() != ErrorKind::usage) throw;
          if (t == 0 && size == sizes.front()) unread += (unread.empty() ? "" : ", ") + std::string(format.name);
          continue;
        }
        if (!same_as_before(out.points, point)) out.points.push_back(std::move(point));
      }
    }
    Panel panel;
    panel.name = truth.name;
    panel.error_floors = {{6e-8, "rounding of a float, 6e-8"}};
    const double least = 8.0 * static_cast<double>(truth.values.size());
    panel.limit = {least, fmt::format("the {} parameters themselves, {:g} bytes", truth.values.size(), least)};
    out.panels.push_back(std::move(panel));
  }
  if (!unread.empty()) out.remarks.push_back("Not written from this source, or not read back by gonio: " + unread + ".");
  return out;
}

}  // namespace gonio::tools::tradeoff
