// SPDX-License-Identifier: BSD-3-Clause
// Grid, density, partners, rotations.
#include "acquisition/plan_points.hpp"

#include <array>
#include <cmath>
#include <map>
#include <random>
#include <utility>

#include "acquisition/density.hpp"

namespace gonio::acquisition {
namespace {

constexpr double microdegrees = 1e6;

/// A pose in whole microdegrees, in normal form: the identity of a point.
using Key = std::array<std::int64_t, 4>;

std::int64_t turned_back(std::int64_t angle) {
  constexpr std::int64_t turn = 360'000'000;
  const std::int64_t rest = ((angle % turn) + turn) % turn;
  return rest > turn / 2 ? rest - turn : rest;
}

Key key_of(double theta_i, double phi_i, double theta_o, double phi_o) {
  const auto whole = [](double angle) { return std::llround(angle * microdegrees); };
  Key key{turned_back(whole(theta_i)), whole(phi_i), turned_back(whole(theta_o)), whole(phi_o)};
  for (const std::size_t theta : {0u, 2u})
    if (key[theta] < 0) key[theta] = -key[theta], key[theta + 1] += whole(180);
  // At normal exit every azimuth is the same direction; that of the light keeps phi_o - phi_i for comparisons across rotations.
  if (key[2] == 0) key[3] = key[1];
  key[1] = turned_back(key[1]);
  key[3] = turned_back(key[3]);
  return key;
}

Key exchanged(const Key& key) { return {key[2], key[3], key[0], key[1]}; }

Pose pose_of(const Key& key) {
  const auto angle = [](std::int64_t whole) { return degrees(static_cast<double>(whole) / microdegrees); };
  return {angle(key[0]), angle(key[1]), angle(key[2]), angle(key[3])};
}

class Points {
 public:
  Points(const PlanRequest& request, const Kinematics& kinematics) : request_(request), kinematics_(kinematics) {}

  std::vector<PlanPoint> all() {
    const std::vector<Key> base = base_keys();
    for (const Key& key : base) add_rotations(key);
    for (const Key& key : chosen(base)) add_rotations(exchanged(key));
    for (std::size_t k = 0; k < points_.size(); ++k)
      if (const auto partner = index_.find(exchanged(keys_[k])); partner != index_.end() && partner->second != k)
        points_[k].partner = partner->second;
    return std::move(points_);
  }

 private:
  /// Grid and density of every incidence, each pose once, in the order of the request.
  std::vector<Key> base_keys() const {
    std::vector<Key> keys;
    std::map<Key, bool> seen;
    const auto add = [&](const Key& key) {
      if (seen.emplace(key, true).second) keys.push_back(key);
    };
    for (const double theta_i : request_.theta_i_deg) {
      const std::vector<Pose> density = specular_density(theta_i, request_.density_points, request_.density_width_deg);
      for (const double phi_i : request_.phi_i_deg) {
        for (const double theta_o : request_.theta_o_deg)
          for (const double phi_o : request_.phi_o_deg) add(key_of(theta_i, phi_i, theta_o, phi_i + phi_o));
        // A light at -theta stands on the other side, and so does its specular direction.
        const double side = phi_i + (theta_i < 0 ? 180 : 0);
        for (const Pose& pose : density) add(key_of(std::abs(theta_i), side, pose.theta_o.degrees(), side + pose.phi_o.degrees()));
      }
    }
    return keys;
  }

  Key rotated(const Key& key, int k) const {
    const double turn = 360.0 * k / request_.rotations;
    return key_of(static_cast<double>(key[0]) / microdegrees, static_cast<double>(key[1]) / microdegrees + turn,
                  static_cast<double>(key[2]) / microdegrees, static_cast<double>(key[3]) / microdegrees + turn);
  }

  bool is_measurable(const Key& key) const {
    for (int k = 0; k < request_.rotations; ++k) {
      const Pose pose = pose_of(rotated(key, k));
      if (kinematics_.masked(pose) || kinematics_.solutions(pose).empty()) return false;
    }
    return true;
  }

  /// Points that get a partner: the first of a seeded shuffle that can have one.
  std::vector<Key> chosen(std::vector<Key> candidates) const {
    // Written out, because the library's shuffle and distributions differ between implementations; the engine's numbers do not.
    std::mt19937_64 random(request_.seed);
    std::vector<Key> keys;
    std::map<Key, bool> taken;
    for (std::size_t left = candidates.size(); left > 0 && keys.size() < static_cast<std::size_t>(request_.reciprocity_pairs); --left) {
      std::swap(candidates[random() % left], candidates[left - 1]);
      const Key& key = candidates[left - 1];
      if (index_.contains(exchanged(key)) || taken.contains(exchanged(key)) || !is_measurable(key) || !is_measurable(exchanged(key)))
        continue;
      taken.emplace(exchanged(key), true);
      keys.push_back(key);
    }
    return keys;
  }

  void add_rotations(const Key& key) {
    for (int k = 0; k < request_.rotations; ++k) add(rotated(key, k), 360.0 * k / request_.rotations);
  }

  void add(const Key& key, double rotation_deg) {
    if (!index_.emplace(key, points_.size()).second) return;
    PlanPoint point;
    point.pose = pose_of(key);
    point.rotation_deg = rotation_deg;
    if (const auto reason = kinematics_.masked(point.pose)) {
      point.state = StepState::masked;
      point.reason = *reason;
    } else if (point.solutions = kinematics_.solutions(point.pose); point.solutions.empty()) {
      point.state = StepState::unreachable;
      point.reason = kinematics_.unreachable_reason(point.pose);
    }
    points_.push_back(std::move(point));
    keys_.push_back(key);
  }

  const PlanRequest& request_;
  const Kinematics& kinematics_;
  std::vector<PlanPoint> points_;
  std::vector<Key> keys_;
  std::map<Key, std::size_t> index_;
};

}  // namespace

std::vector<PlanPoint> plan_points(const PlanRequest& request, const Kinematics& kinematics) { return Points(request, kinematics).all(); }

}  // namespace gonio::acquisition
