// SPDX-License-Identifier: BSD-3-Clause
// How one make of drive maps its functions to Modbus registers: data, never code.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "data-schemas/json.hpp"

namespace gonio::acquisition {

/// A quantity in the register image. 32-bit values take two registers.
struct RegisterField {
  enum class Type { u16, i16, u32, i32 };
  int address = 0;
  Type type = Type::u16;
};

struct StatusBit {
  int bit = 0;
  bool set = true;  ///< the state that means "yes"
};

/// One step of a command: write a value to a field, then wait until (status & mask) == value.
struct CommandStep {
  std::optional<std::string> field;  ///< name of a writable field; none: only wait
  std::uint32_t value = 0;
  std::optional<std::uint16_t> wait_mask;
  std::uint16_t wait_value = 0;
  double timeout_s = 1;
};

struct Alarm {
  std::uint32_t code = 0;
  std::string text;
  bool resettable = true;
};

/// A drive's register image. The built-in `cia402` is the default image of CiA 402 drives over Modbus (acquisition B4).
struct AxisProfile {
  std::string name;
  bool high_word_first = true;
  RegisterField status, error, position, control, mode, target, velocity;
  std::optional<RegisterField> acceleration;
  StatusBit fault, enabled, target_reached, set_point_acknowledged;
  std::vector<CommandStep> enable, start, stop, fault_reset;
  std::optional<RegisterField> watchdog;  ///< register that takes a time-out in ms, or none: warn and limit speed
  std::vector<Alarm> alarms;
};

/// A built-in profile name ("cia402") or a path relative to `folder`. Error(input) with all faults.
AxisProfile load_axis_profile(const std::string& name_or_path, const std::filesystem::path& folder);
AxisProfile axis_profile_from(const Json& document);

}  // namespace gonio::acquisition
