// SPDX-License-Identifier: BSD-3-Clause
// Opening the material files of the RGL database.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <numbers>
#include <optional>
#include <utility>

#include "tabulated/describe.hpp"
#include "tabulated/formats/rgl.hpp"
#include "tabulated/formats/tensor_file.hpp"
#include "tabulated/mapped_file.hpp"

namespace gonio::tabulated {
namespace {

/// Takes fields out of the container and holds them against what the format wants.
class FieldReader {
 public:
  FieldReader(const std::vector<Tensor>& tensors, FaultList& faults) : tensors_(tensors), faults_(faults) {}

  bool has(std::string_view name) const { return find(name) != nullptr; }

  /// The field if it is there with this type and number of dimensions and none of them empty; a fault otherwise.
  const Tensor* take(std::string_view name, TensorType type, std::size_t dimensions) {
    const Tensor* tensor = find(name);
    const std::string wanted = fmt::format("{} in {} dimension{}", gonio::tabulated::name(type), dimensions, dimensions == 1 ? "" : "s");
    if (tensor == nullptr) {
      faults_.add(faults_.file(), fmt::format("no field '{}'", name), wanted);
      return nullptr;
    }
    if (tensor->type != type || tensor->shape.size() != dimensions || tensor->count() == 0) {
      faults_.add(where(name), fmt::format("{} of shape [{}]", gonio::tabulated::name(tensor->type), fmt::join(tensor->shape, ", ")),
                  wanted);
      return nullptr;
    }
    return tensor;
  }

  /// Its numbers, all finite and none below `least`; empty after a fault.
  std::vector<float> numbers(const Tensor* tensor, std::optional<float> least = {}) {
    if (tensor == nullptr) return {};
    std::vector<float> out = tensor->floats();
    bool sound = true;
    for (std::size_t k = 0; k < out.size(); ++k) {
      if (std::isfinite(out[k]) && (!least || out[k] >= *least)) continue;
      faults_.add(fmt::format("{} element {}", where(tensor->name), k), fmt::format("{}", out[k]),
                  least ? "a finite number that is not negative" : "a finite number");
      sound = false;
    }
    if (!sound) out.clear();
    return out;
  }

  /// Increasing numbers of one dimension.
  std::vector<float> axis(std::string_view name) {
    std::vector<float> out = numbers(take(name, TensorType::f32, 1));
    for (std::size_t k = 1; k < out.size(); ++k)
      if (!(out[k] > out[k - 1]))
        faults_.add(fmt::format("{} element {}", where(name), k), fmt::format("{} after {}", out[k], out[k - 1]), "increasing numbers");
    return out;
  }

  /// Holds the extents from `first` on against what other fields demand.
  void require_extents(const Tensor* tensor, std::size_t first, const std::vector<std::size_t>& wanted, const char* why) {
    if (tensor == nullptr || std::find(wanted.begin(), wanted.end(), 0u) != wanted.end()) return;  // that field has its own fault
    if (!std::equal(wanted.begin(), wanted.end(), tensor->shape.begin() + static_cast<std::ptrdiff_t>(first)))
      faults_.add(where(tensor->name), fmt::format("shape [{}]", fmt::join(tensor->shape, ", ")),
                  fmt::format("[{}] from dimension {}: {}", fmt::join(wanted, ", "), first + 1, why));
  }

  /// The last two dimensions must be a grid of at least 2 x 2 nodes, that can be counted in 31 bits.
  void require_grid(const Tensor* tensor) {
    if (tensor == nullptr) return;
    const auto& shape = tensor->shape;
    constexpr std::size_t most = std::size_t{1} << 31;
    if (shape[shape.size() - 2] < 2 || shape.back() < 2 || shape[shape.size() - 2] >= most / shape.back())
      faults_.add(where(tensor->name), fmt::format("shape [{}]", fmt::join(shape, ", ")),
                  "at least 2 x 2 nodes to interpolate between, and fewer than 2^31");
  }

  std::string where(std::string_view name) const { return fmt::format("{} field '{}'", faults_.file(), name); }

 private:
  const Tensor* find(std::string_view name) const {
    const auto at = std::find_if(tensors_.begin(), tensors_.end(), [&](const Tensor& tensor) { return tensor.name == name; });
    return at == tensors_.end() ? nullptr : &*at;
  }

  const std::vector<Tensor>& tensors_;
  FaultList& faults_;
};

void check_angles(const RglArrays& arrays, const FieldReader& fields, FaultList& faults) {
  constexpr double rounding_to_float = 1e-6;
  for (std::size_t k = 0; k < arrays.theta_i.size(); ++k) {
    const double theta = static_cast<double>(arrays.theta_i[k]);
    if (theta < 0 || theta > std::numbers::pi / 2 + rounding_to_float)
      faults.add(fmt::format("{} element {}", fields.where("theta_i"), k), fmt::format("{} rad", theta), "0 to pi/2");
  }
  if (!arrays.phi_i.empty() && RglTable::turns(arrays.phi_i) == 0)
    faults.add(fields.where("phi_i"), fmt::format("{} to {} rad", arrays.phi_i.front(), arrays.phi_i.back()),
               "a whole, a half or a quarter turn, or at most two azimuths of an isotropic material");
}

Channels spectral_channels(const std::vector<float>& wavelengths_nm) {
  Channels out;
  for (const float wavelength : wavelengths_nm) {
    Channel channel;
    channel.name = fmt::format("{}nm", wavelength);
    channel.wavelength_in_nm = channel.wavelength_out_nm = static_cast<double>(wavelength);
    out.push_back(std::move(channel));
  }
  return out;
}

}  // namespace

RglArrays read_rgl(const std::filesystem::path& path) {
  const MappedFile file(path);
  FaultList faults(path.string());
  const std::vector<Tensor> tensors = read_tensors(file.bytes(), faults);
  if (tensors.empty()) faults.raise();

  FieldReader fields(tensors, faults);
  RglArrays arrays;
  if (const Tensor* description = fields.take("description", TensorType::u8, 1)) arrays.description = description->text();
  if (const Tensor* jacobian = fields.take("jacobian", TensorType::u8, 1); jacobian && jacobian->bytes.front() != std::byte{1})
    faults.add(fields.where("jacobian"), fmt::format("{}", static_cast<int>(jacobian->bytes.front())),
               "1: values without the Jacobian are unknown to the format");
  arrays.phi_i = fields.axis("phi_i");
  arrays.theta_i = fields.axis("theta_i");
  check_angles(arrays, fields, faults);

  const Tensor *ndf = fields.take("ndf", TensorType::f32, 2), *sigma = fields.take("sigma", TensorType::f32, 2);
  fields.require_grid(ndf);
  if (ndf != nullptr) fields.require_extents(sigma, 0, ndf->shape, "the grid of 'ndf'");
  arrays.ndf = fields.numbers(ndf, 0.0f);
  arrays.sigma = fields.numbers(sigma, 0.0f);
  for (std::size_t k = 0; k < arrays.sigma.size(); ++k)
    if (arrays.sigma[k] == 0.0f) faults.add(fmt::format("{} element {}", fields.where("sigma"), k), "0", "a positive projected area");

  const std::vector<std::size_t> slices{arrays.phi_i.size(), arrays.theta_i.size()};
  const Tensor *vndf = fields.take("vndf", TensorType::f32, 4), *luminance = fields.take("luminance", TensorType::f32, 4);
  for (const Tensor* tensor : {vndf, luminance}) {
    fields.require_extents(tensor, 0, slices, "one slice per phi_i and theta_i");
    fields.require_grid(tensor);
  }
  if (luminance != nullptr && luminance->shape[2] != luminance->shape[3])
    faults.add(fields.where("luminance"), fmt::format("shape [{}]", fmt::join(luminance->shape, ", ")), "as many rows as columns");
  arrays.vndf = fields.numbers(vndf, 0.0f);

  const bool spectral = fields.has("spectra") || fields.has("wavelengths");
  const Tensor* values = fields.take(spectral ? "spectra" : "rgb", TensorType::f32, 5);
  if (spectral) {
    const std::vector<float> wavelengths = fields.axis("wavelengths");
    if (!wavelengths.empty() && !(wavelengths.front() > 0))
      faults.add(fields.where("wavelengths"), fmt::format("{} nm", wavelengths.front()), "positive wavelengths");
    arrays.channels = spectral_channels(wavelengths);
  } else {
    arrays.channels = rgb_channels();
  }
  fields.require_extents(values, 0, slices, "one slice per phi_i and theta_i");
  fields.require_extents(values, 2, {arrays.channels.size()}, spectral ? "one plane per wavelength" : "red, green and blue");
  arrays.luminance = fields.numbers(luminance);
  if (luminance != nullptr) fields.require_extents(values, 3, {luminance->shape[2], luminance->shape[3]}, "the grid of 'luminance'");
  fields.require_grid(values);
  arrays.values = fields.numbers(values);
  faults.raise();

  arrays.angle_rows = ndf->shape[0], arrays.angle_columns = ndf->shape[1];
  arrays.vndf_rows = vndf->shape[2], arrays.vndf_columns = vndf->shape[3];
  arrays.value_rows = values->shape[3], arrays.value_columns = values->shape[4];
  const std::size_t size = arrays.vndf_rows * arrays.vndf_columns;
  for (std::size_t slice = 0; slice < arrays.vndf.size() / size; ++slice)
    if (!(MarginalWarp::integral(arrays.vndf.data() + slice * size, arrays.vndf_rows, arrays.vndf_columns) > 0))
      faults.add(fmt::format("{} slice {}", fields.where("vndf"), slice), "0 everywhere", "a density of visible half vectors");
  faults.raise();
  return arrays;
}

namespace {

/// The nodes as samples, made when they are first asked for: a table is mostly opened to be evaluated.
class NodeObservations final : public Observations {
 public:
  explicit NodeObservations(std::shared_ptr<const RglTable> table) : table_(std::move(table)) {}

  const Channels& channels() const override { return table_->channels(); }
  Symmetry symmetry() const override { return table_->symmetry(); }
  std::size_t block_count() const override { return samples().block_count(); }
  ObservationBlock block(std::size_t index) const override { return samples().block(index); }
  void geometry(std::size_t index, std::vector<LobeGeometry>& out) const override { samples().geometry(index, out); }
  void angles(std::size_t index, std::vector<GonioAngles>& out) const override { samples().angles(index, out); }

 private:
  const Observations& samples() const {
    std::call_once(once_, [&] { samples_ = observe(std::make_shared<const Dataset>(table_->samples())); });
    return *samples_;
  }

  std::shared_ptr<const RglTable> table_;
  mutable std::once_flag once_;
  mutable std::unique_ptr<Observations> samples_;
};

std::string degrees_of(const std::vector<float>& angles) {
  const auto in_degrees = [](float angle) { return radians(static_cast<double>(angle)).degrees(); };
  return fmt::format("{} from {:.4g} to {:.4g} deg", angles.size(), in_degrees(angles.front()), in_degrees(angles.back()));
}

}  // namespace

bool recognises_rgl(std::string_view head, std::uintmax_t) { return head.starts_with(tensor_file_signature); }

Opened open_rgl(const std::filesystem::path& path, const ReadOptions&) {
  RglArrays arrays = read_rgl(path);
  Opened out;
  out.format = "rgl";
  const bool isotropic = RglTable::is_isotropic(arrays.phi_i);
  out.info = {{"description", arrays.description},
              {"holds", "f cos theta_o, divided by ndf / (4 sigma)"},
              {"unit", "1/sr"},
              {"nodes", "at samples, on a grid adapted to the distribution of half vectors of each incidence"},
              {"theta_i", degrees_of(arrays.theta_i)},
              {"phi_i", isotropic ? "isotropic" : degrees_of(arrays.phi_i)},
              {"values", fmt::format("{} x {} per incidence and channel", arrays.value_rows, arrays.value_columns)},
              {"half vectors", fmt::format("{} x {} per incidence", arrays.vndf_rows, arrays.vndf_columns)},
              {"normals", fmt::format("{} x {} azimuths and zenith angles of ndf and sigma", arrays.angle_rows, arrays.angle_columns)}};
  const auto table = std::make_shared<const RglTable>(std::move(arrays));
  out.info.emplace_back("channels", joined_names(table->channels()));
  out.info.emplace_back("symmetry", words(table->symmetry()));
  out.observations = std::make_shared<const NodeObservations>(table);
  out.brdf = table;
  return out;
}

}  // namespace gonio::tabulated
