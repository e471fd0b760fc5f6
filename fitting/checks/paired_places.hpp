// SPDX-License-Identifier: BSD-3-Clause
// Pairs of places of a data set that are images of each other, as contrasts.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "fitting/checks/contrasts.hpp"
#include "fitting/checks/sample_places.hpp"

namespace gonio::fitting {

/// A symmetry of pairs of directions: which angles are the same place, and where a place's image lies.
struct PlaceSymmetry {
  std::function<PlaceKey(const GonioAngles&)> key;
  std::function<GonioAngles(const GonioAngles&)> image;
};

/// Relative patterns of a sample by its angles and its part of the whole time; the contrast of a pair takes their difference times the
/// mean of the pair.
using Patterns = std::function<std::vector<double>(const GonioAngles&, double part_of_time)>;
/// When every sample was taken as a part of the whole time, 0 … 1; 0 where the data do not say (column `time_s`).
std::vector<double> parts_of_time(const Dataset& dataset);

/// Shared components are taken as independent between data sets: each has its own reference. `first[d]` is the place of the first
/// component of data set d in Reading::shared, `first.back()` their number.
std::vector<std::size_t> first_components(const std::vector<std::shared_ptr<const Dataset>>& datasets);

/// A reading from the samples of one place and channel; none if no sample has a value.
std::optional<Reading> reading_of(const Dataset& dataset, std::size_t channel, const std::vector<std::size_t>& samples, std::size_t first,
                                  std::size_t components);

/// Adds f(place) - f(image) for every place of every channel whose image was measured too, each pair once.
void add_pairs(const std::vector<std::shared_ptr<const Dataset>>& datasets, const PlaceSymmetry& symmetry, const Patterns& patterns,
               Contrasts& out);

/// The mirror image about the plane of incidence: the same wi, phi_o - phi_i reversed.
GonioAngles mirrored(const GonioAngles& angles) noexcept;
/// Mirror pairs with the directed tests "the side of the plane of incidence" and "time".
Contrasts mirror_pairs(const std::vector<std::shared_ptr<const Dataset>>& datasets);

}  // namespace gonio::fitting
