// SPDX-License-Identifier: BSD-3-Clause
#include "tabulated/neighbourhood.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tabulated/convex_hull.hpp"
#include "tabulated/interpolation_error.hpp"

namespace gonio::tabulated {
namespace {

/// Distance, in steps of the plan, at which a pair is the sample's own: rounding of directions made from angles.
constexpr double same_place = 1e-5;
/// Steps beyond the hull of the neighbours that a chord across a curved edge of the measured region explains.
constexpr double hull_tolerance = 0.3;
/// Neighbours that must surround a pair, if those that take part in its value do not.
constexpr std::size_t hull_neighbours = 64;
/// A pair farther from its nearest sample than this, and than the samples there from one another, lies in a gap [steps].
constexpr double gap = 1.5;
constexpr std::size_t gap_neighbours = 6;
/// Edge of the boxes [steps]: small against the reach, so that the neighbours of the centre are those of every place in it.
constexpr double box_edge = 0.5;
/// Samples inside a box that may take part; the others surround it.
constexpr std::size_t most_inside = 10;

bool in_box(const PairPoint& at, const PairPoint& centre, const PairPoint& half) {
  for (std::size_t axis = 0; axis < at.size(); ++axis)
    if (std::fabs(at[axis] - centre[axis]) > half[axis] + same_place) return false;
  return true;
}

/// True if the whole box lies within the convex hull, which it does if its corners do.
bool box_within_hull(const PairPoint& centre, const PairPoint& half, const std::vector<PairPoint>& points) {
  for (unsigned corner = 0; corner < 16; ++corner) {
    PairPoint at = centre;
    bool again = false;
    for (std::size_t axis = 0; axis < at.size(); ++axis) {
      const bool upper = (corner >> axis) & 1;
      again = again || (upper && half[axis] == 0);
      at[axis] += upper ? half[axis] : -half[axis];
    }
    if (!again && !within_hull(at, points, hull_tolerance)) return false;
  }
  return true;
}

/// The finaliser of splitmix64 (G. L. Steele et al., "Fast splittable pseudorandom number generators", OOPSLA 2014) on a mix of the axes.
std::uint64_t hash(const Neighbourhoods::Box& box) noexcept {
  std::uint64_t out = 0;
  for (const std::int64_t axis : box) out = (out ^ static_cast<std::uint64_t>(axis)) * 0x9e3779b97f4a7c15;
  out = (out ^ (out >> 30)) * 0xbf58476d1ce4e5b9;
  out = (out ^ (out >> 27)) * 0x94d049bb133111eb;
  return out ^ (out >> 31);
}

}  // namespace

Neighbourhood::Neighbourhood(const GuidedSamples& samples, const CorrelationRanges& ranges, const PairPoint& centre,
                             const PairPoint& half) {
  const NeighbourTree& tree = *samples.places;
  const double radius = std::sqrt(squared_distance(half, {}));
  thread_local std::vector<Neighbour> found, inside;
  constexpr std::size_t most_about = 4 * most_inside;  // in the ball about the box
  tree.around(centre, {.most = most_about, .reach = radius + 2 * same_place, .hidden = 0}, inside);
  const bool not_all = inside.size() == most_about;
  std::erase_if(inside, [&](const Neighbour& one) { return !in_box(tree[one.point], centre, half); });
  crowded_ = radius > 0 && (not_all || inside.size() > most_inside);
  if (crowded_) return;
  tree.around(centre, {.most = kriging_neighbours, .reach = kriging_reach}, found);
  far_ = found.empty();
  if (far_) {
    tree.around(centre, {.most = 1}, found);
    tree.around(centre, {.most = kriging_neighbours, .reach = std::sqrt(found[0].squared) + kriging_reach}, found);
  }
  // Samples of the box take part whether they hide or not: at each of them its own value is wanted.
  if (radius > 0) {
    std::erase_if(found, [&](const Neighbour& one) { return in_box(tree[one.point], centre, half); });
    found.resize(std::min(found.size(), kriging_neighbours - inside.size()));
    found.insert(found.end(), inside.begin(), inside.end());
    std::sort(found.begin(), found.end(), [](const Neighbour& a, const Neighbour& b) { return a.squared < b.squared; });
  }
  for (const Neighbour& neighbour : found) places_.push_back(neighbour.point), points_.push_back(tree[neighbour.point]);
  if (radius == 0 && nearest(centre).is_here) {
    places_.resize(1), points_.resize(1);
    return;
  }
  system_ = KrigingSystem(points_, ranges);
  if (!far_) find_edges(samples, centre, half);
}

void Neighbourhood::find_edges(const GuidedSamples& samples, const PairPoint& centre, const PairPoint& half) {
  const NeighbourTree& tree = *samples.places;
  const double radius = std::sqrt(squared_distance(half, {})), nearest = std::sqrt(squared_distance(points_[0], centre));
  thread_local std::vector<Neighbour> found;
  inside_ = box_within_hull(centre, half, points_);
  if (!inside_) {
    tree.around(centre, {.most = hull_neighbours, .reach = kriging_reach}, found);
    for (const Neighbour& neighbour : found) wider_.push_back(tree[neighbour.point]);
  }
  // A place of the box has its nearest sample, or masked direction, within this distance of the centre.
  const double nearest_to_any = nearest + 2 * radius;
  if (nearest + radius > gap) {
    own_step_.assign(places_.size(), 0.0);
    for (std::size_t k = 0; k < places_.size() && squared_distance(points_[k], centre) <= nearest_to_any * nearest_to_any; ++k) {
      tree.around(points_[k], {.most = gap_neighbours}, found);
      own_step_[k] = std::sqrt(found.back().squared);
    }
  }
  samples.masked->around(centre, {.most = hull_neighbours, .reach = nearest_to_any}, found);
  for (const Neighbour& neighbour : found) masked_.push_back((*samples.masked)[neighbour.point]);
}

Neighbourhood::Nearest Neighbourhood::nearest(const PairPoint& at) const noexcept {
  Nearest out{0, std::numeric_limits<double>::infinity(), false};
  for (std::size_t k = 0; k < points_.size(); ++k)
    if (const double squared = squared_distance(points_[k], at); squared < out.squared) out = {k, squared, false};
  out.is_here = out.squared < same_place * same_place;
  return out;
}

Coverage Neighbourhood::coverage(const PairPoint& at, const Nearest& nearest) const noexcept {
  if (far_ || nearest.squared > kriging_reach * kriging_reach) return Coverage::extrapolated;
  if (!inside_ && !within_hull(at, points_, hull_tolerance) && !within_hull(at, wider_, hull_tolerance)) return Coverage::extrapolated;
  if (!own_step_.empty() && nearest.squared > gap * gap && nearest.squared > own_step_[nearest.index] * own_step_[nearest.index])
    return Coverage::extrapolated;
  for (const PairPoint& masked : masked_)
    if (squared_distance(masked, at) <= nearest.squared) return Coverage::extrapolated;
  return Coverage::interpolated;
}

Neighbourhoods::Neighbourhoods(const GuidedSamples& samples, const CorrelationRanges& ranges)
    : samples_(samples), ranges_(ranges), buckets_(bucket_count) {}

Neighbourhoods::Box Neighbourhoods::box_of(const PairPoint& at) noexcept {
  Box out;
  for (std::size_t axis = 0; axis < at.size(); ++axis) out[axis] = static_cast<std::int64_t>(std::floor(at[axis] / box_edge));
  return out;
}

std::shared_ptr<const Neighbourhood> Neighbourhoods::of(const Box& box) const {
  const std::size_t number = hash(box) % bucket_count;
  Bucket& bucket = buckets_[number];
  std::mutex& mutex = mutexes_[number % mutex_count];
  {
    const std::lock_guard lock(mutex);
    for (std::size_t way = 0; way < Bucket::ways; ++way)
      if (bucket.kept[way] && bucket.boxes[way] == box) return bucket.kept[way];
  }
  PairPoint centre{}, half{};
  for (std::size_t axis = 0; axis < centre.size(); ++axis) {
    if (axis == 3 && samples_.isotropic) continue;  // all places lie at 0 there
    centre[axis] = (static_cast<double>(box[axis]) + 0.5) * box_edge, half[axis] = 0.5 * box_edge;
  }
  auto made = std::make_shared<const Neighbourhood>(samples_, ranges_, centre, half);
  const std::lock_guard lock(mutex);
  bucket.boxes[bucket.next] = box, bucket.kept[bucket.next] = made;
  bucket.next = (bucket.next + 1) % Bucket::ways;
  return made;
}

}  // namespace gonio::tabulated
