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

/// A quantity in the register image. 32-bit values take two registers, `address` and `address + 1`.
struct RegisterField {
  enum class Type { u16, i16, u32, i32 };
  int address = 0;
  Type type = Type::u16;
  int function_code = 3;  ///< how it is read (3, 4) or written (6, 16); written fields are read back with 3
  double scale = 1;       ///< quantity = register · scale; counts, counts/s and counts/s² for position, velocity and acceleration

  int registers() const noexcept { return type == Type::u32 || type == Type::i32 ? 2 : 1; }
};

struct StatusBit {
  int bit = 0;
  bool set = true;  ///< the state that means "yes"

  bool in(std::uint16_t status) const noexcept { return (((status >> bit) & 1) != 0) == set; }
};

/// One step of a command: write a value to a field, then wait until (status & mask) == value. An edge is two steps: set, then clear.
struct CommandStep {
  std::optional<std::string> field;  ///< `control`, `mode`, ...: a field that is written; none: only wait
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

/// A contiguous range that holds status, error and position and is read in one request.
struct PollBlock {
  int function_code = 3, address = 0, count = 0;
};

/// A request and its answer as the maker of the drive prints them (Modbus PDU, hexadecimal).
struct GoldenFrame {
  std::string what, request, response;
};

/// A drive's register image. The built-in `cia402` is the default image of CiA 402 drives over Modbus (acquisition B4).
struct AxisProfile {
  std::string name;
  std::vector<std::string> transports;  ///< `modbus-tcp`, `modbus-rtu`
  bool high_word_first = true;
  RegisterField status, error, position, control, mode, target, velocity;
  std::optional<RegisterField> acceleration;
  StatusBit fault, enabled, target_reached, set_point_acknowledged;
  std::optional<StatusBit> limit_active, homed;
  std::vector<CommandStep> enable, start, stop, quick_stop, fault_reset;
  std::vector<CommandStep> homing;        ///< empty: the drive has an absolute encoder or is homed by hand
  std::optional<RegisterField> watchdog;  ///< register that takes a time-out in ms, or none: warn and limit speed
  std::optional<PollBlock> poll;          ///< none: every field is read by itself
  std::vector<Alarm> alarms;
  std::vector<GoldenFrame> golden_frames;

  /// A field that commands may write, by its name (`control`, `mode`, `target`, `velocity`, `acceleration`, `watchdog`), or nullptr.
  const RegisterField* written_field(const std::string& field) const noexcept;
  /// "error 0x7305: sensor fault", from the alarm table; an unknown code is said to be unknown.
  std::string alarm_text(std::uint32_t code) const;
};

/// A built-in profile name ("cia402") or a path relative to `folder`. Error(input) with all faults.
AxisProfile load_axis_profile(const std::string& name_or_path, const std::filesystem::path& folder);
/// From a document; validates it against the schema and checks what a schema cannot say. `source` names it in faults.
AxisProfile axis_profile_from(const Json& document, const std::string& source = "axis profile");

}  // namespace gonio::acquisition
