// SPDX-License-Identifier: BSD-3-Clause
#include "fitting/global_search.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "fitting/stretch_search.hpp"
#include "fitting/thinned.hpp"
#include "fitting/threads.hpp"

namespace gonio::fitting {
namespace {

constexpr std::size_t scan_points = 61;
constexpr double brent_tolerance = 1e-9, coarse = 1e-4;  // on the axis; coarse: of a part of the rows
/// A rise smaller than this part of the largest cost of the scan is rounding, not a barrier between two minima.
constexpr double ripple = 1e-12;
constexpr std::size_t many_rows = 1000;        // worth several threads
constexpr std::size_t rows_for_search = 2048;  // of a thinned search
constexpr std::size_t grid_points = 25;        // along each of two axes
constexpr std::size_t sequence_points = 512;   // of the low-discrepancy sequence
constexpr int steps_to_basin = 10;             // of a first descent, which need only tell minima apart
constexpr std::size_t most_candidates = 16, most_minima = 8;
constexpr double far_apart = 0.1;    // part of an axis: a nearer candidate is left to the better one's descent
constexpr double same_place = 1e-6;  // part of an axis: two descents that ended in one minimum
constexpr double barrier = 1e-6;     // part of the cost: a lower rise between two minima is none
constexpr int barrier_points = 5;    // looked at between two minima

/// Minimum of `f` on [a, b] (Brent 1973, chapter 5): golden section with parabolic steps where they are trusted.
template <class F>
double brent(F&& f, double a, double b, double tolerance) {
  const double golden = 0.5 * (3 - std::sqrt(5.0));
  double x = a + golden * (b - a), w = x, v = x, fx = f(x), fw = fx, fv = fx, step = 0, before = 0;
  for (int iteration = 0; iteration < 100; ++iteration) {
    const double middle = 0.5 * (a + b), tol = tolerance + 1e-15 * std::abs(x);
    if (std::abs(x - middle) <= 2 * tol - 0.5 * (b - a)) break;
    bool parabola = false;
    if (std::abs(before) > tol) {
      const double r = (x - w) * (fx - fv), q0 = (x - v) * (fx - fw);
      double p = (x - v) * q0 - (x - w) * r, q = 2 * (q0 - r);
      if (q > 0) p = -p;
      q = std::abs(q);
      if (std::abs(p) < std::abs(0.5 * q * before) && p > q * (a - x) && p < q * (b - x)) {
        before = step;
        step = p / q;
        parabola = true;
        if (x + step - a < 2 * tol || b - x - step < 2 * tol) step = std::copysign(tol, middle - x);
      }
    }
    if (!parabola) {
      before = (x < middle ? b : a) - x;
      step = golden * before;
    }
    const double u = x + (std::abs(step) >= tol ? step : std::copysign(tol, step)), fu = f(u);
    if (fu <= fx) {
      (u < x ? b : a) = x;
      v = w, fv = fw, w = x, fw = fx, x = u, fx = fu;
    } else {
      (u < x ? a : b) = u;
      if (fu <= fw || w == x) {
        v = w, fv = fw, w = u, fw = fu;
      } else if (fu <= fv || v == x || v == w) {
        v = u, fv = fu;
      }
    }
  }
  return x;
}

void sort_by_cost(std::vector<Minimum>& minima) {
  std::stable_sort(minima.begin(), minima.end(), [](const Minimum& a, const Minimum& b) { return a.point.cost < b.point.cost; });
}

double along(const SearchAxis& axis, std::size_t k, std::size_t points) {
  return axis.scan_low + (axis.scan_high - axis.scan_low) * static_cast<double>(k) / static_cast<double>(points - 1);
}

std::vector<ProfilePoint> scan_axis(const Profile& profile, const SearchSpace& space, int threads) {
  std::vector<ProfilePoint> points(scan_points);
  for_each_index(scan_points, profile.terms().rows() > many_rows || profile.terms().sums ? threads : 1, [&](std::size_t k) {
    const double z = along(space.axes().front(), k, scan_points);
    points[k] = profile.at(space.theta(std::span(&z, 1)));
  });
  return points;
}

std::vector<Minimum> minima_of_scan(const Profile& profile, const SearchSpace& space, const std::vector<ProfilePoint>& scan, int threads,
                                    double tolerance) {
  double largest = 0;
  for (const ProfilePoint& point : scan)
    if (std::isfinite(point.cost)) largest = std::max(largest, point.cost);
  const double rise = ripple * largest;
  std::vector<Minimum> found;
  // From the left: a point is the lowest since the last barrier if the cost has risen by more than a ripple before and after it.
  std::size_t lowest = 0;
  bool falling = true;
  double highest = scan[0].cost;
  const SearchAxis& axis = space.axes().front();
  const auto at = [&](double z) { return profile.at(space.theta(std::span(&z, 1)), threads); };
  const auto refine = [&](std::size_t k) {
    Minimum minimum{{along(axis, k, scan_points)}, scan[k]};
    const double a = along(axis, k == 0 ? 0 : k - 1, scan_points), b = along(axis, std::min(k + 1, scan.size() - 1), scan_points);
    const double x = brent([&](double z) { return at(z).cost; }, a, b, tolerance);
    ProfilePoint point = at(x);
    if (point.cost < minimum.point.cost - rise * 1e-3 || (point.cost < minimum.point.cost && k > 0 && k + 1 < scan.size()))
      minimum = {{x}, std::move(point)};
    // At an end of the scan the minimum may lie beyond it.
    if ((k == 0 && axis.low < axis.scan_low) || (k + 1 == scan.size() && axis.high > axis.scan_high)) {
      DescentOptions options;
      options.threads = threads;
      minimum = descend(profile, space, minimum.z, options);
    }
    found.push_back(std::move(minimum));
  };
  for (std::size_t k = 1; k < scan.size(); ++k) {
    if (falling) {
      if (scan[k].cost < scan[lowest].cost) lowest = k;
      if (scan[k].cost > scan[lowest].cost + rise) {
        refine(lowest);
        falling = false;
        highest = scan[k].cost;
      }
    } else {
      highest = std::max(highest, scan[k].cost);
      if (scan[k].cost < highest - rise) falling = true, lowest = k;
    }
  }
  if (falling) refine(lowest);
  sort_by_cost(found);
  return found;
}

/// A point of the search before any descent.
struct Candidate {
  std::vector<double> z;
  double cost = 0;
};

std::vector<Candidate> costs_at(const Profile& profile, const SearchSpace& space, std::vector<std::vector<double>> places, int threads) {
  std::vector<Candidate> out(places.size());
  for_each_index(places.size(), profile.terms().rows() * places.size() > many_rows ? threads : 1, [&](std::size_t k) {
    out[k].cost = profile.at(space.theta(places[k])).cost;
    out[k].z = std::move(places[k]);
  });
  return out;
}

/// The local minima of a grid over two axes; of equal terms only the ordered half is looked at.
std::vector<Candidate> grid_candidates(const Profile& profile, const SearchSpace& space, int threads) {
  std::vector<std::vector<double>> places;
  std::vector<std::size_t> number(grid_points * grid_points);
  for (std::size_t i = 0; i < grid_points; ++i)
    for (std::size_t j = 0; j < grid_points; ++j) {
      std::vector<double> z{along(space.axes()[0], i, grid_points), along(space.axes()[1], j, grid_points)};
      number[i * grid_points + j] = places.size();
      if (space.ordered(space.theta(z)))
        places.push_back(std::move(z));
      else
        number[i * grid_points + j] = grid_points * grid_points;
    }
  const std::vector<Candidate> all = costs_at(profile, space, std::move(places), threads);
  const auto cost = [&](std::ptrdiff_t i, std::ptrdiff_t j) {
    const auto size = static_cast<std::ptrdiff_t>(grid_points);
    const std::size_t at = i < 0 || j < 0 || i >= size || j >= size ? all.size() : number[static_cast<std::size_t>(i * size + j)];
    return at < all.size() ? all[at].cost : std::numeric_limits<double>::infinity();
  };
  std::vector<Candidate> out;
  for (std::ptrdiff_t i = 0; i < static_cast<std::ptrdiff_t>(grid_points); ++i)
    for (std::ptrdiff_t j = 0; j < static_cast<std::ptrdiff_t>(grid_points); ++j) {
      const double own = cost(i, j);
      bool lowest = std::isfinite(own);
      for (std::ptrdiff_t a = -1; a <= 1; ++a)
        for (std::ptrdiff_t b = -1; b <= 1; ++b) lowest = lowest && cost(i + a, j + b) >= own;
      if (lowest) out.push_back(all[number[static_cast<std::size_t>(i) * grid_points + static_cast<std::size_t>(j)]]);
    }
  return out;
}

/// Points that fill the space evenly: multiples of powers of 1/g modulo 1, g the root of g^(d+1) = g + 1 (Roberts 2018).
std::vector<Candidate> sequence_candidates(const Profile& profile, const SearchSpace& space, int threads) {
  const std::size_t d = space.dimension();
  double g = 1.5;
  for (int k = 0; k < 60; ++k) g = std::pow(1 + g, 1.0 / static_cast<double>(d + 1));
  std::vector<std::vector<double>> places;
  for (std::size_t n = 0; n < sequence_points; ++n) {
    std::vector<double> z(d);
    double step = 1;
    for (std::size_t a = 0; a < d; ++a) {
      step /= g;
      const double part = std::fmod(0.5 + static_cast<double>(n + 1) * step, 1.0);
      z[a] = space.axes()[a].scan_low + part * (space.axes()[a].scan_high - space.axes()[a].scan_low);
    }
    std::vector<double> theta = space.theta(z);
    std::vector<std::vector<double>> none;
    space.order(theta, none);
    places.push_back(space.coordinates(theta));
  }
  return costs_at(profile, space, std::move(places), threads);
}

/// Largest distance on any axis, as a part of it.
double distance(const SearchSpace& space, const std::vector<double>& a, const std::vector<double>& b) {
  double out = 0;
  for (std::size_t k = 0; k < a.size(); ++k)
    out = std::max(out, std::abs(a[k] - b[k]) / std::max(space.axes()[k].scan_high - space.axes()[k].scan_low, 1e-300));
  return out;
}

/// Whether the profile rises between two points: else they belong to one minimum.
bool separated(const Profile& profile, const SearchSpace& space, const Minimum& a, const Minimum& b, int threads) {
  if (distance(space, a.z, b.z) < same_place) return false;
  const double floor = std::max(a.point.cost, b.point.cost);
  for (int k = 1; k <= barrier_points; ++k) {
    const double part = static_cast<double>(k) / (barrier_points + 1);
    std::vector<double> z(a.z.size());
    for (std::size_t i = 0; i < z.size(); ++i) z[i] = a.z[i] + part * (b.z[i] - a.z[i]);
    if (profile.at(space.theta(z), threads).cost > floor * (1 + barrier)) return true;
  }
  return false;
}

/// The distinct ones, the lowest first.
std::vector<Minimum> distinct(const Profile& profile, const SearchSpace& space, std::vector<Minimum> all, int threads) {
  sort_by_cost(all);
  std::vector<Minimum> out;
  for (Minimum& next : all) {
    if (out.size() == most_minima) break;
    const bool is_new =
        std::all_of(out.begin(), out.end(), [&](const Minimum& known) { return separated(profile, space, known, next, threads); });
    if (is_new) out.push_back(std::move(next));
  }
  return out;
}

void order(Minimum& minimum, const Profile& profile, const SearchSpace& space, int threads) {
  if (space.ordered(minimum.point.theta)) return;
  std::vector<std::vector<double>> none;
  space.order(minimum.point.theta, none);
  minimum.z = space.coordinates(minimum.point.theta);
  minimum.point = profile.at(minimum.point.theta, threads);
}

std::vector<Minimum> descend_from_all(const Profile& profile, const SearchSpace& space, const std::vector<std::vector<double>>& starts,
                                      int threads, int most_steps = DescentOptions{}.most_steps) {
  std::vector<Minimum> out(starts.size());
  const bool split = profile.terms().rows() <= rows_for_search;  // many rows have threads of their own
  DescentOptions options;
  options.most_steps = most_steps;
  options.threads = split ? 1 : threads;
  for_each_index(starts.size(), split ? threads : 1, [&](std::size_t k) {
    out[k] = descend(profile, space, starts[k], options);
    order(out[k], profile, space, options.threads);
  });
  return distinct(profile, space, std::move(out), threads);
}

std::vector<std::vector<double>> places_of(const std::vector<Minimum>& minima) {
  std::vector<std::vector<double>> out;
  for (const Minimum& minimum : minima) out.push_back(minimum.z);
  return out;
}

/// Whether the profile falls towards a point from both sides, a step of the scan away: a minimum of some rows may be none of all.
bool falls_on_both_sides(const Profile& profile, const SearchSpace& space, const Minimum& at, int threads) {
  const SearchAxis& axis = space.axes().front();
  const double step = (axis.scan_high - axis.scan_low) / (scan_points - 1);
  const auto cost = [&](double z) { return profile.at(space.theta(std::span(&z, 1)), threads).cost; };
  const double z = at.z.front(), middle = cost(z);
  return (z - step < axis.low || cost(z - step) > middle) && (z + step > axis.high || cost(z + step) > middle);
}

/// The points worth a descent, far from each other, the lowest first.
std::vector<std::vector<double>> starts_among(const SearchSpace& space, std::vector<Candidate> candidates) {
  std::stable_sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
  std::vector<std::vector<double>> starts;
  for (const Candidate& candidate : candidates) {
    if (starts.size() == most_candidates || !std::isfinite(candidate.cost)) break;
    const bool near = std::any_of(starts.begin(), starts.end(), [&](const auto& z) { return distance(space, z, candidate.z) < far_apart; });
    if (!near) starts.push_back(candidate.z);
  }
  return starts;
}

/// The sums of a part of the rows, without rows.
Terms part_of_sums(const Terms& terms, int threads) {
  Terms out;
  out.kernel = terms.kernel;
  out.transform = terms.transform;
  out.channel.resize(terms.channel.size());
  out.sums = terms.sums->few(threads);
  return out;
}

Found search_rows(const Profile& profile, const SearchSpace& space, int threads) {
  Found found;
  if (space.dimension() == 1) {
    found.scan = scan_axis(profile, space, threads);
    found.minima = minima_of_scan(profile, space, found.scan, threads, brent_tolerance);
    const SearchAxis& axis = space.axes().front();
    if (axis.low < axis.scan_low || axis.high > axis.scan_high) found.scan.clear();  // it does not reach the ends
  } else {
    std::vector<Candidate> candidates =
        space.dimension() == 2 ? grid_candidates(profile, space, threads) : sequence_candidates(profile, space, threads);
    const std::vector<Minimum> basins =
        descend_from_all(profile, space, starts_among(space, std::move(candidates)), threads, steps_to_basin);
    found.minima = descend_from_all(profile, space, places_of(basins), threads);
  }
  return found;
}

}  // namespace

Found search_axis(const Profile& profile, const SearchSpace& space, int threads, double tolerance) {
  Found found;
  found.scan = scan_axis(profile, space, threads);
  found.minima = minima_of_scan(profile, space, found.scan, threads, tolerance);
  return found;
}

Minimum lowest_between(const Profile& profile, const SearchSpace& space, double low, double high, int threads) {
  const auto at = [&](double z) { return profile.at(space.theta(std::span(&z, 1)), threads); };
  const double z = brent([&](double x) { return at(x).cost; }, low, high, brent_tolerance);
  return {{z}, at(z)};
}

Found search_globally(Profile& profile, const SearchSpace& space, int threads, std::vector<Minimum> known) {
  const Terms& terms = profile.terms();
  if (space.dimension() == 0) return {{}, {{{}, profile.at(space.theta({}), threads)}}};
  const bool line = space.dimension() == 1;
  // Twice as many rows are still searched whole: thinning them gains less than the second look at all rows costs.
  if (!terms.sums && terms.rows() <= 2 * rows_for_search && (line || known.empty())) return search_rows(profile, space, threads);
  std::size_t looked_at = std::min(terms.rows(), rows_for_search);  // at least, by whoever knows the minima
  if (terms.sums) {
    const Terms few = part_of_sums(terms, threads);
    looked_at = few.sums->rows();
    known = search_axis(Profile(few, profile.limits()), space, threads, coarse).minima;
  } else if (known.empty()) {
    const Terms few = thinned(terms, rows_for_search);
    known = search_rows(Profile(few, profile.limits()), space, threads).minima;
  }
  const auto refined = [&](std::vector<Minimum> minima) {
    if (!terms.sums) return descend_from_all(profile, space, places_of(minima), threads);
    for (Minimum& minimum : minima) minimum.point = profile.at(minimum.point.theta, threads);
    return minima;
  };
  if (line && terms.transform.linear()) {
    if (std::optional<StretchFound> found = search_on_stretch(profile, space, known.front(), looked_at, threads)) {
      std::vector<Minimum> others(known.begin() + 1, known.end());
      if (!terms.sums) std::erase_if(others, [&](const Minimum& other) { return !falls_on_both_sides(profile, space, other, threads); });
      others = refined(std::move(others));
      std::erase_if(others, [&](const Minimum& other) { return found->covers(other.z.front()); });
      if (std::all_of(others.begin(), others.end(), [&](const Minimum& other) { return other.point.cost > found->well_above; })) {
        others.insert(others.begin(), std::move(found->lowest));
        return {std::move(found->scan), distinct(profile, space, std::move(others), threads)};
      }
      profile.forget();
    }
  }
  return terms.sums ? search_axis(profile, space, threads, brent_tolerance) : Found{{}, refined(std::move(known))};
}

}  // namespace gonio::fitting
