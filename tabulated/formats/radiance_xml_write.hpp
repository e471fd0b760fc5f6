// SPDX-License-Identifier: BSD-3-Clause
// What the writers of Radiance's XML share: the document, its colours and the notes.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "tabulated/channel_map.hpp"
#include "tabulated/klems_basis.hpp"
#include "tabulated/open.hpp"

namespace gonio::tabulated {

/// One <WavelengthDataBlock> with its <WavelengthData> around it.
struct RadianceBlock {
  const char* wavelength;  ///< `Visible`, `CIE-X`, ...
  bool front;
  std::string data;
};

/// `basis` is null for tensor trees.
std::string radiance_document(const std::string& structure, const KlemsBasis* basis, const std::string& material,
                              const std::vector<RadianceBlock>& blocks);

/// One channel as it is, everything else as r, g, b. Throws Error(input) for transmission and for a source that cannot be evaluated.
ChannelMap radiance_channels(const Opened& source);

/// What became of means on their way into a file.
struct RadianceMeans {
  std::size_t unknown = 0, negative = 0, unsettled = 0;
  double largest_unsettled = 0;           ///< relative difference of the last two rules
  std::array<double, 3> hemispherical{};  ///< the largest, of each channel
  void add(const RadianceMeans& other);
};
/// Makes a mean ready to be written: 0 for a negative or unknown one, which is counted.
std::array<double, 3> written_mean(std::array<double, 3> f, bool known, double unsettled, RadianceMeans& means);
/// Facts and losses of `means` in sentences.
void note_means(const RadianceMeans& means, const ChannelMap& map, ExportNotes& notes);

}  // namespace gonio::tabulated
