// SPDX-License-Identifier: BSD-3-Clause
// What every gantry, detector and source promises, whatever is behind it: the same checks for every implementation.
#pragma once

#include <cmath>
#include <functional>
#include <numbers>

#include "acquisition/connect.hpp"
#include "brdf/error.hpp"
#include "tests/check.hpp"

namespace gonio::acquisition::test {

/// The kind of the Error that `action` throws; fails the test if there is none.
inline ErrorKind error_kind(const std::function<void()>& action, std::string* text = nullptr) {
  try {
    action();
  } catch (const Error& e) {
    if (text) *text = e.what();
    return e.kind();
  }
  FAIL("no error");
  return ErrorKind::internal;
}

inline void check_gantry_contract(Gantry& gantry, const Bench& bench) {
  const auto is_at = [&](const AxisState& s, const AxisAngles& target) {
    CHECK(s.in_position);
    for (std::size_t k = 0; k < target.size(); ++k) {
      CHECK(s.counts[k] == bench.axes[k].counts(target[k]));
      CHECK(s.degrees[k] == bench.axes[k].degrees(s.counts[k]));
    }
  };
  const AxisAngles there{10.25, -33.3333333, 120, 0.0000004}, back{-170, 60, -180, -45.5};
  is_at(gantry.move_to(there), there);
  is_at(gantry.read_back(), there);
  is_at(gantry.move_to(there), there);  // again: nothing to do
  is_at(gantry.move_to(back), back);

  // Limits are inclusive; beyond them nothing moves, not even the axes whose targets are allowed.
  AxisAngles beyond = there;
  beyond[0] = std::nextafter(bench.axes[0].upper_deg, 1e9);
  std::string text;
  CHECK(error_kind([&] { gantry.move_to(beyond); }, &text) == ErrorKind::limit);
  CHECK(text.find(bench.axes[0].name) != std::string::npos);
  beyond[0] = std::nan("");
  CHECK(error_kind([&] { gantry.move_to(beyond); }) == ErrorKind::limit);
  is_at(gantry.read_back(), back);
  AxisAngles edge = back;
  edge[0] = bench.axes[0].upper_deg;
  is_at(gantry.move_to(edge), edge);
  CHECK(error_kind([&] { gantry.move_to({1, 2}); }) == ErrorKind::internal);

  CHECK(gantry.stop());
  CHECK_FALSE(gantry.read_back().in_position);  // a stop takes the command back
  is_at(gantry.move_to(there), there);
}

/// Needs the shutter closed and a bench without noise and dark.
inline void check_detector_contract(Detector& detector, const Clock& clock, const Bench& bench) {
  CHECK(detector.identity().starts_with(bench.expected_idn));
  CHECK(error_kind([&] { detector.read(0.1); }) == ErrorKind::internal);  // not configured
  detector.configure(bench.wavelength_nm, bench.range_w, 0.1);
  const BenchTime begin = clock.now();
  CHECK(detector.read(0.3) == 0);
  CHECK(seconds(clock.now() - begin) == Approx(0.3));
  CHECK(error_kind([&] { detector.configure(1e6, bench.range_w, 0.1); }) == ErrorKind::device);
  detector.configure(bench.wavelength_nm, bench.range_w, 0.1);
  CHECK(detector.read(0.1) == 0);
}

/// Light reaches the detector only through an open shutter, and from what is presented.
inline void check_source_contract(Source& source, Detector& detector, Gantry& gantry, const Bench& bench) {
  gantry.move_to({0, -30, 0, 20});
  detector.configure(bench.wavelength_nm, bench.range_w, 0.1);
  const auto read = [&](StepKind kind) {
    source.announce({1, kind, 0, 0});
    source.present(kind);
    return detector.read(0.1);
  };
  source.open_shutter(true);
  const double white = read(StepKind::reference), sample = read(StepKind::sample);
  CHECK(white == Approx(bench.source_power_w * bench.reference.f_per_sr * std::cos(20 * std::numbers::pi / 180)));
  CHECK(sample > 0);
  CHECK(sample != white);
  source.open_shutter(false);
  CHECK(read(StepKind::dark) == 0);
  source.open_shutter(true);
  source.open_shutter(true);
  CHECK(read(StepKind::sample) == sample);
  CHECK(source.make_safe());
  CHECK(detector.read(0.1) == 0);
}

inline void check_device_contract(ConnectedBench& devices, const Bench& bench) {
  check_gantry_contract(*devices.gantry, bench);
  check_detector_contract(*devices.detector, *devices.clock, bench);
  check_source_contract(*devices.source, *devices.detector, *devices.gantry, bench);
}

}  // namespace gonio::acquisition::test
