// SPDX-License-Identifier: BSD-3-Clause
// Writing material files as those of the RGL database.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include "brdf/error.hpp"
#include "data-schemas/write_file.hpp"
#include "tabulated/channel_map.hpp"
#include "tabulated/describe.hpp"
#include "tabulated/formats/rgl.hpp"
#include "tabulated/formats/rgl_build.hpp"
#include "tabulated/formats/rgl_error.hpp"
#include "tabulated/formats/sphere_scene.hpp"
#include "tabulated/formats/tensor_file.hpp"

namespace gonio::tabulated {
namespace {

bool is_rgb(const Channels& channels) { return channels == rgb_channels(); }

Tensor floats(std::string name, std::vector<std::size_t> shape, const std::vector<float>& values) {
  return {std::move(name), TensorType::f32, std::move(shape), std::as_bytes(std::span(values))};
}

Tensor bytes(std::string name, std::string_view text) {
  return {std::move(name), TensorType::u8, {text.size()}, std::as_bytes(std::span(text))};
}

/// The arrays with other channels: the map is linear, as the format is in its values.
RglArrays mapped(RglArrays arrays, const ChannelMap& map) {
  const std::size_t plane = arrays.value_rows * arrays.value_columns, from = arrays.channels.size(), to = map.to.size();
  const std::size_t slices = arrays.phi_i.size() * arrays.theta_i.size();
  std::vector<float> values(slices * to * plane);
  std::vector<double> in(from), out(to);
  for (std::size_t slice = 0; slice < slices; ++slice)
    for (std::size_t k = 0; k < plane; ++k) {
      for (std::size_t c = 0; c < from; ++c) in[c] = static_cast<double>(arrays.values[(slice * from + c) * plane + k]);
      map.apply(in.data(), out.data());
      for (std::size_t c = 0; c < to; ++c) values[(slice * to + c) * plane + k] = static_cast<float>(out[c]);
    }
  arrays.values = std::move(values);
  arrays.channels = map.to;
  return arrays;
}

/// From coarse to fine; the last is the finest that `--error` may choose.
std::vector<RglGrid> candidates(bool isotropic) {
  std::vector<RglGrid> out;
  if (isotropic)
    for (const auto& [theta, value, density] : {std::array<std::size_t, 3>{8, 32, 128},
                                                {16, 48, 128},
                                                {32, 64, 128},
                                                {32, 96, 128},
                                                {64, 128, 256},
                                                {64, 192, 256},
                                                {64, 256, 256}})
      out.push_back({1, theta, value, density, 2, 128});
  else
    for (const auto& [phi, theta, value] :
         {std::array<std::size_t, 3>{9, 8, 32}, {17, 8, 32}, {17, 16, 48}, {17, 16, 64}, {33, 16, 48}, {33, 16, 64}, {65, 16, 64}})
      out.push_back({phi, theta, value, 64, 129, 128});
  return out;
}

/// The coarsest candidate whose read-back keeps the error, with the curve in the facts.
RglArrays adapted(const Opened& source, const ChannelMap& map, const WriteOptions& options, ExportNotes& notes) {
  std::string curve;
  RglArrays arrays;
  const auto grids = candidates(source.brdf->symmetry().isotropic);
  for (const RglGrid& grid : grids) {
    ExportNotes of_this;
    arrays = build_rgl(source, grid, map, options.threads, of_this);
    const double error = mean_relative_error(*source.brdf, map, RglTable(arrays), options.threads);
    curve += fmt::format("{}{}: {} bytes, {:.3g} %", curve.empty() ? "" : "; ", words(grid), grid.bytes(map.to.size()), 100 * error);
    const bool last = &grid == &grids.back(), kept = error <= *options.error;
    if (!kept && !last) continue;
    notes = std::move(of_this);
    notes.facts.emplace_back("grid", words(grid));
    notes.facts.emplace_back("mean relative error", fmt::format("{:.3g} % (wanted: {:.3g} %)", 100 * error, 100 * *options.error));
    notes.facts.emplace_back("errors by grid", curve);
    if (!kept) notes.lost.push_back(fmt::format("the wanted error is not reached by the finest grid that is tried, {}", words(grid)));
    break;
  }
  return arrays;
}

ExportNotes write(const Opened& source, const std::filesystem::path& path, const WriteOptions& options,
                  ChannelMap (*map_to)(const Channels&)) {
  if (!source.brdf)
    throw Error(ErrorKind::input, {path.string(), fmt::format("a {} that cannot be evaluated", source.format), "a model or a table"});
  if (source.dataset && source.dataset->side == Side::transmission)
    throw Error(ErrorKind::input, {path.string(), "transmission", "reflection: the format holds nothing else"});
  const ChannelMap map = map_to(source.brdf->channels());
  ExportNotes notes;
  RglArrays arrays;
  if (const auto* table = dynamic_cast<const RglTable*>(source.brdf.get())) {
    arrays = mapped(table->arrays(), map);
    notes.n_nodes = arrays.luminance.size();
    notes.facts.emplace_back("grid", "the source's own, values unchanged at its nodes");
  } else {
    const bool isotropic = source.brdf->symmetry().isotropic;
    if (options.error) {
      arrays = adapted(source, map, options, notes);
    } else {
      const RglGrid grid = rgl_grid(options.size, isotropic);
      arrays = build_rgl(source, grid, map, options.threads, notes);
      notes.facts.emplace_back("grid", words(grid));
    }
    arrays.description = fmt::format("gonio export of a {}, {}{}", source.format, isotropic ? "isotropic" : "anisotropic",
                                     source.simulated ? ", simulated" : "");
    if (notes.n_negative > 0) notes.lost.emplace_back("negative values are written as 0");
    if (notes.n_unknown > 0) notes.lost.emplace_back("where nothing is known the file continues the nodes around it");
  }
  if (!map.changed.empty()) notes.lost.push_back(map.changed);
  if (source.uncertain || (source.dataset && source.dataset->has_uncertainty()))
    notes.lost.emplace_back("uncertainties have no place in the file");
  if (source.brdf->delta()) notes.lost.emplace_back("the ideal mirror part has no place in the file");
  write_rgl(arrays, path);
  notes.files = {path};
  if (options.scene)
    for (const auto& scene : write_sphere_scenes(is_rgb(arrays.channels) ? "rgl" : "rgl-spectral", path)) {
      notes.files.push_back(scene);
      notes.facts.emplace_back("scene", scene.filename().string());
    }
  notes.facts.emplace_back("quantity", "f cos theta_o 4 sigma / ndf, jacobian 1");
  notes.facts.emplace_back("channels", joined_names(arrays.channels));
  return notes;
}

}  // namespace

void write_rgl(const RglArrays& a, const std::filesystem::path& path) {
  const std::size_t p = a.phi_i.size(), t = a.theta_i.size(), channels = a.channels.size();
  const std::string_view jacobian("\1", 1);
  std::vector<float> wavelengths;
  std::vector<Tensor> tensors{bytes("description", a.description.empty() ? "-" : std::string_view(a.description)),
                              floats("phi_i", {p}, a.phi_i),
                              floats("theta_i", {t}, a.theta_i),
                              floats("sigma", {a.angle_rows, a.angle_columns}, a.sigma),
                              floats("ndf", {a.angle_rows, a.angle_columns}, a.ndf),
                              floats("vndf", {p, t, a.vndf_rows, a.vndf_columns}, a.vndf),
                              floats("luminance", {p, t, a.value_rows, a.value_columns}, a.luminance)};
  if (is_rgb(a.channels)) {
    tensors.push_back(floats("rgb", {p, t, channels, a.value_rows, a.value_columns}, a.values));
  } else {
    for (const Channel& channel : a.channels) wavelengths.push_back(static_cast<float>(channel.wavelength_out_nm.value()));
    tensors.push_back(floats("wavelengths", {channels}, wavelengths));
    tensors.push_back(floats("spectra", {p, t, channels, a.value_rows, a.value_columns}, a.values));
  }
  tensors.push_back(bytes("jacobian", jacobian));
  write_file_atomically(path, tensor_bytes(tensors));
}

ExportNotes write_rgl_rgb(const Opened& source, const std::filesystem::path& path, const WriteOptions& options) {
  return write(source, path, options, map_to_rgb);
}

ExportNotes write_rgl_spectral(const Opened& source, const std::filesystem::path& path, const WriteOptions& options) {
  return write(source, path, options, map_to_spectrum);
}

}  // namespace gonio::tabulated
