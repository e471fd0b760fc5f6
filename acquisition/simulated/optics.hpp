// SPDX-License-Identifier: BSD-3-Clause
// What falls on the detector of the simulated bench.
#pragma once

#include <memory>

#include "acquisition/bench.hpp"
#include "acquisition/clock.hpp"
#include "acquisition/devices.hpp"
#include "brdf/aperture.hpp"
#include "brdf/brdf.hpp"

namespace gonio::acquisition::simulated {

/// How things stand during an exposure.
struct Exposure {
  Pose pose;  ///< where the axes really are
  bool shutter_open = false;
  bool white_in_beam = false;
  BenchTime middle = 0;
  double exposure_s = 0;
  ReadingTag tag;  ///< keys the noise
};

/// The signal [W] with the spot inside the receiver's field (measurement equation, relative form):
///   S = Phi(t) · f(pose) · ∫ cos theta dΩ over the receiver + dark + noise,   Phi(t) = source power · (1 + drift · t).
/// The white is Lambertian with the certified f, apart from the certificate's error. Each effect only if the bench file asks for it.
/// f is the first channel of the sample, its mean over the apertures the bench states (brdf/aperture.hpp); at the pose itself where both
/// are 0.
class Optics {
 public:
  Optics(const Bench& bench, std::shared_ptr<const Brdf> sample);
  /// NaN where the sample's value is not known.
  double signal_w(const Exposure& exposure) const;

 private:
  double sample_f(const Pose& pose) const;

  SimulatedEffects effects_;
  std::uint64_t seed_;
  double source_power_w_, white_f_;
  Angle receiver_half_angle_;
  ApertureRule apertures_;
  std::shared_ptr<const Brdf> sample_;
};

}  // namespace gonio::acquisition::simulated
