// SPDX-License-Identifier: BSD-3-Clause
// A BRDF as matrices over Klems' patches.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <mutex>

#include "data-schemas/write_file.hpp"
#include "tabulated/cell_mean.hpp"
#include "tabulated/formats/radiance_xml.hpp"
#include "tabulated/formats/radiance_xml_write.hpp"
#include "tabulated/formats/sphere_scene.hpp"
#include "tabulated/in_parallel.hpp"
#include "tabulated/radiance_colour.hpp"

namespace gonio::tabulated {
namespace {

/// Two rules that agree to a thousandth: the finer one is far closer, and Radiance itself shakes values by 3e-4.
constexpr double settled = 1e-3;

/// Points a dimension at least where a lobe may be: a narrower one hides between the points of coarser rules. Samples may
/// have theirs anywhere.
constexpr std::size_t first_order = 2, first_order_at_lobes = 4, first_order_of_samples = 3;

/// The directions of a patch: u and v of [0, 1] cut it into parts of equal projected solid angle.
class PatchDirections {
 public:
  explicit PatchDirections(const KlemsBasis::Patch& patch)
      : phi_(degrees(patch.centre_phi_deg).radians()), width_(degrees(patch.width_deg).radians()) {
    const double lower = degrees(patch.ring->lower_deg).sin(), upper = degrees(patch.ring->upper_deg).sin();
    sine2_ = lower * lower, growth_ = upper * upper - lower * lower;
  }
  Direction operator()(double u, double v) const {
    const double sine2 = sine2_ + u * growth_, sine = std::sqrt(sine2), phi = phi_ + (v - 0.5) * width_;
    return Direction::trusted(sine * std::cos(phi), sine * std::sin(phi), std::sqrt(1 - sine2));
  }

 private:
  double phi_, width_, sine2_, growth_;
};

/// Matrix of one side of the sheet: [out · size + in], three channels.
using Matrix = std::vector<std::array<double, 3>>;

class MatrixWriter {
 public:
  MatrixWriter(const Opened& source, const ChannelMap& map, const KlemsBasis& basis)
      : source_(source), basis_(basis), mean_(source, map, {2, 3, 4, 6, 8, 12, 16}, settled) {}

  Matrix write(bool front, int threads, RadianceMeans& means, ExportNotes& notes) const {
    Matrix out(basis_.size() * basis_.size());
    std::mutex mutex;
    in_parallel(basis_.size(), threads, [&](std::size_t in) {
      RadianceMeans row;
      ExportNotes counts;
      for (std::size_t to = 0; to < basis_.size(); ++to) {
        const std::array<double, 3> f = mean(in, to, front, row, counts);
        out[to * basis_.size() + in] = f;
        for (std::size_t c = 0; c < 3; ++c) row.hemispherical[c] += f[c] * basis_.projected_solid_angle(to);
      }
      const std::lock_guard lock(mutex);
      means.add(row);
      add_counts(counts, notes);
    });
    return out;
  }

 private:
  std::array<double, 3> mean(std::size_t in, std::size_t to, bool front, RadianceMeans& means, ExportNotes& notes) const {
    const PatchDirections from(basis_.patch(in)), towards(basis_.patch(to));
    const double sign = front ? -1 : 1;
    const auto pair = [&](std::span<const double> at) {
      const Direction shadow = from(at[0], at[1]), wo = towards(at[2], at[3]);
      return DirectionPair{Direction::trusted(-shadow.x(), -sign * shadow.y(), shadow.z()),
                           Direction::trusted(wo.x(), sign * wo.y(), wo.z())};
    };
    const CellMean::Result result = mean_(4, pair, order(in, to), notes);
    return written_mean(result.f, result.known, result.unsettled, means);
  }

  /// More points where the mirror or the retro direction may lie in the patch or beside it.
  std::size_t order(std::size_t in, std::size_t to) const {
    const Direction mirror = Direction::spherical(basis_.centre_theta(in), basis_.centre_phi(in));
    const Direction retro = Direction::trusted(-mirror.x(), -mirror.y(), mirror.z());
    const Direction wo = Direction::spherical(basis_.centre_theta(to), basis_.centre_phi(to));
    const double reach = radius_deg(in) + radius_deg(to);
    const double nearest = std::min(angle_between(mirror, wo).degrees(), angle_between(retro, wo).degrees());
    if (nearest <= reach) return first_order_at_lobes;
    return source_.dataset ? first_order_of_samples : first_order;
  }

  /// Of a circle about the centre that holds the patch.
  double radius_deg(std::size_t index) const {
    const KlemsBasis::Patch patch = basis_.patch(index);
    if (patch.ring->patches == 1) return patch.ring->upper_deg;
    return std::hypot(0.5 * (patch.ring->upper_deg - patch.ring->lower_deg), 0.5 * patch.width_deg * degrees(patch.ring->upper_deg).sin());
  }

  const Opened& source_;
  const KlemsBasis& basis_;
  CellMean mean_;
};

std::string text_of(const Matrix& matrix, std::size_t columns, const std::function<double(const std::array<double, 3>&)>& value) {
  std::string out;
  for (std::size_t k = 0; k < matrix.size(); ++k)
    fmt::format_to(std::back_inserter(out), "{}{}", static_cast<float>(value(matrix[k])), (k + 1) % columns == 0 ? '\n' : '\t');
  return out;
}

ExportNotes write(const Opened& source, const std::filesystem::path& path, const WriteOptions& options, const KlemsBasis& basis) {
  const ChannelMap map = radiance_channels(source);
  const MatrixWriter writer(source, map, basis);
  ExportNotes notes;
  RadianceMeans means;
  const Matrix back = writer.write(false, options.threads, means, notes);
  // Turned over, a surface that is the same in the mirror is the same.
  const bool same = source.brdf->symmetry().bilateral && source.brdf->symmetry().isotropic;
  const Matrix front = same ? back : writer.write(true, options.threads, means, notes);

  const bool colour = map.to.size() == 3;
  std::vector<RadianceBlock> blocks;
  for (const bool is_front : {false, true}) {
    const Matrix& matrix = is_front ? front : back;
    const auto component = [&](std::size_t c) {
      return text_of(matrix, basis.size(), [&](const std::array<double, 3>& f) { return colour ? xyz_of_rgb(f)[c] : f[0]; });
    };
    blocks.push_back({"Visible", is_front, component(1)});
    if (!colour) continue;
    blocks.push_back({"CIE-X", is_front, component(0)});
    blocks.push_back({"CIE-Z", is_front, component(2)});
  }
  write_file_atomically(path, radiance_document("Columns", &basis, path.stem().string(), blocks));
  notes.files = {path};
  if (options.scene)
    for (const auto& scene : write_sphere_scenes("radiance-xml", path)) notes.files.push_back(scene);
  notes.facts.emplace_back("grid", fmt::format("{} x {} pairs of patches, {}", basis.size(), basis.size(), basis.name()));
  note_means(means, map, notes);
  return notes;
}

}  // namespace

ExportNotes write_radiance_klems_full(const Opened& source, const std::filesystem::path& path, const WriteOptions& options) {
  return write(source, path, options, KlemsBasis::full());
}
ExportNotes write_radiance_klems_half(const Opened& source, const std::filesystem::path& path, const WriteOptions& options) {
  return write(source, path, options, KlemsBasis::half());
}
ExportNotes write_radiance_klems_quarter(const Opened& source, const std::filesystem::path& path, const WriteOptions& options) {
  return write(source, path, options, KlemsBasis::quarter());
}

}  // namespace gonio::tabulated
