// SPDX-License-Identifier: BSD-3-Clause
// An emulated CiA 402 drive in profile position mode.
#pragma once

#include "acquisition/bench.hpp"
#include "acquisition/simulated/register_unit.hpp"

namespace gonio::acquisition::simulated {

/// The state machine and the bits of CiA 402-2 (status word 6041h, control word 6040h), at the addresses, widths and word order of the
/// axis' profile. Its meaning of the bits is its own, not the profile's: a profile that is wrong about them meets a drive that
/// does not obey. Position is an exact function of the last command and the time; without `motion` a move takes none.
class DriveUnit final : public RegisterUnit {
 public:
  DriveUnit(const Axis& axis, bool motion);

  void refresh(BenchTime now) override;
  bool is_writable(int address) const override;
  void written(int address, int count, BenchTime now) override;

  std::int64_t position(BenchTime now) const;
  double position_deg(BenchTime now) const;

 private:
  enum class State { switch_on_disabled, ready_to_switch_on, switched_on, operation_enabled, quick_stop_active };
  void control(std::uint16_t word, BenchTime now);
  void move_to(std::int64_t target, BenchTime now);
  void brake(BenchTime now);
  bool is_moving(BenchTime now) const;
  std::uint16_t status(BenchTime now) const;
  void store(const RegisterField& field, std::int64_t value);
  std::int64_t load(const RegisterField& field);

  Axis axis_;
  bool motion_;
  State state_ = State::switch_on_disabled;
  std::uint16_t control_ = 0;
  bool acknowledged_ = false, reached_ = true;

  // The last move: from `from_` at `start_`, over `distance_` counts in `duration_s_`; a braking one begins at full `speed_`.
  BenchTime start_ = 0;
  std::int64_t from_ = 0;
  double distance_ = 0, duration_s_ = 0, speed_, acceleration_;
  bool braking_ = false;
};

}  // namespace gonio::acquisition::simulated
