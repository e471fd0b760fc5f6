// SPDX-License-Identifier: BSD-3-Clause
// Opening MERL files.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>

#include "data-schemas/document.hpp"
#include "tabulated/describe.hpp"
#include "tabulated/fault_list.hpp"
#include "tabulated/formats/merl.hpp"
#include "tabulated/mapped_file.hpp"

namespace gonio::tabulated {
namespace {

static_assert(std::endian::native == std::endian::little, "MERL's numbers are used where they lie");

using Dimensions = std::array<std::int32_t, 3>;
constexpr Dimensions wanted_dimensions{MerlGrid::theta_h_count, MerlGrid::theta_d_count, MerlGrid::phi_d_count};

void require_shape(std::span<const std::byte> bytes, const std::filesystem::path& path) {
  FaultList faults(path.string());
  if (bytes.size() != merl_file_size)
    faults.add(path.string(), fmt::format("{} bytes", bytes.size()), fmt::format("{} bytes", merl_file_size));
  if (bytes.size() >= merl_header_size) {
    Dimensions found;
    std::memcpy(found.data(), bytes.data(), sizeof found);
    if (found != wanted_dimensions)
      faults.add(path.string(), fmt::format("dimensions {}", fmt::join(found, " x ")),
                 fmt::format("dimensions {}", fmt::join(wanted_dimensions, " x ")));
  }
  faults.raise();
}

/// One pass over the file: how many cells are masked, and a fault for each number that is none.
std::size_t count_masked(const MerlPlanes& planes, const std::filesystem::path& path) {
  constexpr std::size_t chunk = 1024;  // 24 kB: the copies stay in the first-level cache
  std::array<std::array<double, chunk>, 3> values;
  FaultList faults(path.string());
  std::size_t masked = 0;
  for (std::size_t first = 0; first < MerlGrid::cell_count; first += chunk) {
    const std::size_t count = std::min(chunk, MerlGrid::cell_count - first);
    for (std::size_t c = 0; c < 3; ++c)
      std::memcpy(values[c].data(), static_cast<const std::byte*>(planes.first[c]) + first * sizeof(double), count * sizeof(double));
    double not_finite = 0;  // 0 x finite is 0, 0 x infinity and 0 x NaN are NaN
    for (std::size_t k = 0; k < count; ++k) {
      masked += std::min({values[0][k], values[1][k], values[2][k]}) < 0 ? 1 : 0;
      not_finite += 0 * values[0][k] + 0 * values[1][k] + 0 * values[2][k];
    }
    if (not_finite == 0) continue;
    for (std::size_t k = 0; k < count; ++k)
      for (std::size_t c = 0; c < 3; ++c)
        if (!std::isfinite(values[c][k])) {
          const MerlCell cell = MerlGrid::cell(first + k);
          faults.add(fmt::format("{} cell theta_h {}, theta_d {}, phi_d {}", path.string(), cell.theta_h, cell.theta_d, cell.phi_d),
                     fmt::format("{} in plane {}", values[c][k], c + 1), "a finite number, negative where nothing was measured");
        }
  }
  faults.raise();
  if (masked == MerlGrid::cell_count)
    throw Error(ErrorKind::input, {path.string(), "a table with every cell masked", "at least one value"});
  return masked;
}

struct Sidecar {
  std::optional<MerlNodes> nodes;
  bool simulated = false;
  std::string source, values;
};

Sidecar read_sidecar(const std::filesystem::path& path) {
  const std::filesystem::path file = merl_sidecar(path);
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return {};
  const Json document = parse_json(read_file(file), file.string());
  FaultList faults(file.string());
  Sidecar out;
  const auto text = [&](const char* key) -> std::string {
    const Json& member = document.get(key);
    if (member.is_string()) return member.string();
    if (!member.is_null()) faults.add(fmt::format("{}#/{}", file.string(), key), "something that is no text", "text");
    return "";
  };
  const std::string nodes = text("node_rule");
  for (const MerlNodes rule : {MerlNodes::left, MerlNodes::centre})
    if (nodes == name(rule)) out.nodes = rule;
  if (!nodes.empty() && !out.nodes) faults.add(file.string() + "#/node_rule", excerpt(nodes), "left or centre");
  out.source = text("source");
  out.values = text("values");
  const Json& simulated = document.get("context").get("simulated");
  out.simulated = simulated.is_bool() && simulated.boolean();
  faults.raise();
  return out;
}

}  // namespace

std::filesystem::path merl_sidecar(const std::filesystem::path& path) {
  std::filesystem::path out = path;
  out += ".json";
  return out;
}

const char* name(MerlNodes nodes) noexcept { return nodes == MerlNodes::left ? "left" : "centre"; }

bool recognises_merl(std::string_view head, std::uintmax_t size) {
  if (size == merl_file_size) return true;
  if (head.empty()) return false;
  Dimensions found{};
  const std::size_t count = std::min(head.size(), sizeof found);
  std::memcpy(found.data(), head.data(), count);
  if (std::memcmp(head.data(), wanted_dimensions.data(), count) == 0) return true;  // even if cut inside the header
  // Three plausible sizes of a table; text has much larger integers in its first bytes.
  return count == sizeof found && std::all_of(found.begin(), found.end(), [](std::int32_t n) { return n > 0 && n <= 4096; });
}

Opened open_merl(const std::filesystem::path& path, const ReadOptions& options) {
  const auto file = std::make_shared<const MappedFile>(path);
  require_shape(file->bytes(), path);
  const Sidecar sidecar = read_sidecar(path);
  MerlPlanes planes;
  for (std::size_t c = 0; c < 3; ++c) planes.first[c] = file->bytes().data() + merl_header_size + c * MerlGrid::cell_count * sizeof(double);
  planes.scale = MerlPlanes::file_scale;
  planes.owner = file;

  Opened out;
  out.format = "merl";
  out.masked.missing = count_masked(planes, path);
  const MerlNodes nodes = options.merl_nodes.value_or(sidecar.nodes.value_or(MerlNodes::left));
  out.observations = observe_merl(planes, nodes);
  const auto table = std::make_shared<const HalfDifferenceTable>(planes, nodes);
  out.brdf = table;
  out.simulated = sidecar.simulated;
  const char* said_by = options.merl_nodes ? "as asked" : sidecar.nodes ? "from the sidecar" : "by default, no sidecar";
  out.info = {{"holds", "f / scale, cosine not included"},
              {"unit", "1/sr"},
              {"cells", fmt::format("90 x 90 x 180 (theta_h, theta_d, phi_d), {} masked", out.masked.missing)},
              {"channels", joined_names(table->channels())},
              {"nodes", fmt::format("{} of the cells ({})", nodes == MerlNodes::left ? "left edges" : "centres", said_by)},
              {"colour", "linear, primaries undefined"},
              {"symmetry", words(table->symmetry())},
              {"simulated", out.simulated ? "yes" : "no"}};
  if (!sidecar.values.empty()) out.info.emplace_back("values", sidecar.values == "cell_mean" ? "means over the cells" : "at the nodes");
  if (!sidecar.source.empty()) out.info.emplace_back("source", sidecar.source);
  return out;
}

}  // namespace gonio::tabulated
