// SPDX-License-Identifier: BSD-3-Clause
// Parameters of the ABg model by incidence, as text.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

#include "brdf/brdf.hpp"
#include "tabulated/formats/abg_fit.hpp"
#include "tabulated/open.hpp"

namespace gonio::tabulated {

struct AbgRow {
  double incidence_deg = 0;
  AbgParameters parameters;
};

/// f = A / (B + |β - β0|^g); between incidences A, B and g are linear in cos theta_i, beyond them constant, as in OpticStudio's ABg
/// scatter data catalogs. Trap: not reciprocal unless all rows are equal.
class AbgTable final : public Brdf {
 public:
  /// `rows` by increasing incidence, not empty.
  AbgTable(std::vector<AbgRow> rows, Channels channels) : rows_(std::move(rows)), channels_(std::move(channels)) {}
  const std::vector<AbgRow>& rows() const noexcept { return rows_; }

  const Channels& channels() const override { return channels_; }
  Symmetry symmetry() const override { return {true, true, rows_.size() == 1}; }
  using Brdf::eval;
  void eval(std::span<const Direction> wi, std::span<const Direction> wo, std::span<double> f) const override;

 private:
  std::vector<AbgRow> rows_;
  Channels channels_;
};

/// The text that `write_abg` writes: `NAME`, `WAVE` (µm, 0 = unknown), `ALL A B g`, and lines `ANGLE theta_i A B g`; `#` starts a comment.
bool recognises_abg(std::string_view head, std::uintmax_t size);
Opened open_abg(const std::filesystem::path& path, const ReadOptions& options);

/// Fits A, B and g at ten incidences (as many as OpticStudio's catalog takes) and once to all of them (FRED's ABg model has one set), on
/// ln f over 16 azimuths and 60 radial angles, even in their logarithm, and prints what remains. One channel: of colours the luminance.
ExportNotes write_abg(const Opened& source, const std::filesystem::path& path, const WriteOptions& options);

}  // namespace gonio::tabulated
