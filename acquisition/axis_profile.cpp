// SPDX-License-Identifier: BSD-3-Clause
// Reading an axis profile and checking what its schema cannot say.
#include "acquisition/axis_profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "brdf/error.hpp"
#include "data-schemas/document.hpp"

namespace gonio::acquisition {
namespace {

constexpr int register_count = 65536;  // addresses of one Modbus unit

std::uint32_t hexadecimal(const Json& text) { return static_cast<std::uint32_t>(std::stoul(text.string(), nullptr, 16)); }

RegisterField::Type type_named(const std::string& name) {
  using enum RegisterField::Type;
  return name == "u16" ? u16 : name == "i16" ? i16 : name == "u32" ? u32 : i32;
}

RegisterField field(const Json& json) {
  return {static_cast<int>(json.at("address").number()), type_named(json.at("type").string()), static_cast<int>(json.at("fc").number()),
          json.number_or("scale", 1)};
}

std::optional<RegisterField> optional_field(const Json& json) { return json.is_null() ? std::nullopt : std::optional(field(json)); }

StatusBit status_bit(const Json& json) { return {static_cast<int>(json.at("bit").number()), json.boolean_or("set", true)}; }

std::optional<StatusBit> optional_status_bit(const Json& json) { return json.is_null() ? std::nullopt : std::optional(status_bit(json)); }

std::vector<CommandStep> command(const Json& json) {
  std::vector<CommandStep> steps;
  for (std::size_t k = 0; k < json.size(); ++k) {
    CommandStep step;
    if (const Json& write = json[k].get("write"); !write.is_null()) {
      step.field = write.at("field").string();
      step.value = hexadecimal(write.at("value"));
    }
    if (const Json& wait = json[k].get("wait"); !wait.is_null()) {
      step.wait_mask = static_cast<std::uint16_t>(hexadecimal(wait.at("mask")));
      step.wait_value = static_cast<std::uint16_t>(hexadecimal(wait.at("value")));
      step.timeout_s = wait.at("timeout_s").number();
    }
    steps.push_back(std::move(step));
  }
  return steps;
}

AxisProfile read(const Json& document) {
  AxisProfile p;
  p.name = document.at("name").string();
  for (const Json& transport : document.at("transports").elements()) p.transports.push_back(transport.string());
  p.high_word_first = document.at("word_order").string() == "high-first";
  const Json& reads = document.at("read");
  p.status = field(reads.at("status"));
  p.error = field(reads.at("error"));
  p.position = field(reads.at("position"));
  const Json& writes = document.at("write");
  p.control = field(writes.at("control"));
  p.mode = field(writes.at("mode"));
  p.target = field(writes.at("target"));
  p.velocity = field(writes.at("velocity"));
  p.acceleration = optional_field(writes.get("acceleration"));
  p.watchdog = optional_field(document.at("watchdog"));
  const Json& bits = document.at("status_bits");
  p.fault = status_bit(bits.at("fault"));
  p.enabled = status_bit(bits.at("enabled"));
  p.target_reached = status_bit(bits.at("target_reached"));
  p.set_point_acknowledged = status_bit(bits.at("set_point_acknowledged"));
  p.limit_active = optional_status_bit(bits.get("limit_active"));
  p.homed = optional_status_bit(bits.get("homed"));
  const Json& commands = document.at("commands");
  p.enable = command(commands.at("enable"));
  p.start = command(commands.at("start"));
  p.stop = command(commands.at("stop"));
  p.quick_stop = command(commands.get("quick_stop"));
  p.fault_reset = command(commands.at("fault_reset"));
  p.homing = command(document.at("homing"));
  if (const Json& poll = document.get("poll"); !poll.is_null())
    p.poll = PollBlock{static_cast<int>(poll.at("fc").number()), static_cast<int>(poll.at("address").number()),
                       static_cast<int>(poll.at("count").number())};
  for (const Json& alarm : document.at("alarms").elements())
    p.alarms.push_back({hexadecimal(alarm.at("code")), alarm.at("text").string(), alarm.at("resettable").boolean()});
  for (std::size_t k = 0; k < document.get("golden_frames").size(); ++k) {
    const Json& frame = document.at("golden_frames")[k];
    p.golden_frames.push_back({frame.at("what").string(), frame.at("request").string(), frame.at("response").string()});
  }
  return p;
}

struct NamedField {
  const char* pointer;
  const RegisterField* field;
};

std::vector<NamedField> written_fields(const AxisProfile& p) {
  std::vector<NamedField> fields{
      {"/write/control", &p.control}, {"/write/mode", &p.mode}, {"/write/target", &p.target}, {"/write/velocity", &p.velocity}};
  if (p.acceleration) fields.push_back({"/write/acceleration", &*p.acceleration});
  if (p.watchdog) fields.push_back({"/watchdog", &*p.watchdog});
  return fields;
}

void check_fields(const AxisProfile& p, std::vector<Fault>& faults) {
  const auto one_of = [&](const char* pointer, const RegisterField& f, std::initializer_list<RegisterField::Type> types,
                          const char* wanted) {
    if (std::find(types.begin(), types.end(), f.type) == types.end())
      faults.push_back({std::string(pointer) + "/type", "a type that does not hold this quantity", wanted});
  };
  using enum RegisterField::Type;
  one_of("/read/status", p.status, {u16}, "u16");
  one_of("/read/error", p.error, {u16, u32}, "u16 or u32");
  one_of("/read/position", p.position, {i16, i32}, "i16 or i32: positions have a sign");
  one_of("/write/control", p.control, {u16}, "u16");
  one_of("/write/target", p.target, {i16, i32}, "i16 or i32: positions have a sign");
  if (p.position.scale != p.target.scale)
    faults.push_back(
        {"/write/target/scale", fmt::format("{:g}", p.target.scale), fmt::format("{:g}, that of the position", p.position.scale)});

  const std::vector<NamedField> written = written_fields(p);
  std::vector<NamedField> all{{"/read/status", &p.status}, {"/read/error", &p.error}, {"/read/position", &p.position}};
  all.insert(all.end(), written.begin(), written.end());
  for (const auto& [pointer, f] : all)
    if (f->address + f->registers() > register_count)
      faults.push_back({std::string(pointer) + "/address", std::to_string(f->address), "an address with room for the whole value"});
  for (const auto& [pointer, f] : written)
    if (f->function_code == 6 && f->registers() > 1)
      faults.push_back({std::string(pointer) + "/fc", "6, which writes one register", "16 for a value of two registers"});
  for (std::size_t a = 0; a < written.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      if (written[a].field->address < written[b].field->address + written[b].field->registers() &&
          written[b].field->address < written[a].field->address + written[a].field->registers())
        faults.push_back({std::string(written[a].pointer) + "/address", std::to_string(written[a].field->address),
                          fmt::format("registers that {} does not use", written[b].pointer)});
  if (!p.poll) return;
  for (const auto& [pointer, f] : all) {
    if (f != &p.status && f != &p.error && f != &p.position) continue;
    if (f->function_code != p.poll->function_code || f->address < p.poll->address ||
        f->address + f->registers() > p.poll->address + p.poll->count)
      faults.push_back(
          {"/poll",
           fmt::format("function {}, registers {} to {}", p.poll->function_code, p.poll->address, p.poll->address + p.poll->count - 1),
           fmt::format("a range that holds {}", pointer)});
  }
}

void check_commands(const AxisProfile& p, std::vector<Fault>& faults) {
  const std::array<std::pair<const char*, const std::vector<CommandStep>*>, 6> commands{{{"/commands/enable", &p.enable},
                                                                                         {"/commands/start", &p.start},
                                                                                         {"/commands/stop", &p.stop},
                                                                                         {"/commands/quick_stop", &p.quick_stop},
                                                                                         {"/commands/fault_reset", &p.fault_reset},
                                                                                         {"/homing", &p.homing}}};
  for (const auto& [pointer, steps] : commands)
    for (std::size_t k = 0; k < steps->size(); ++k) {
      const CommandStep& step = (*steps)[k];
      if (step.field) {
        const RegisterField* f = p.written_field(*step.field);
        if (!f)
          faults.push_back({fmt::format("{}/{}/write/field", pointer, k), *step.field, "a field that this profile has under `write`"});
        else if (f->registers() == 1 && step.value > 0xFFFF)
          faults.push_back(
              {fmt::format("{}/{}/write/value", pointer, k), fmt::format("{:#x}", step.value), "a value that fits its one register"});
      }
      if (step.wait_mask && (step.wait_value & ~*step.wait_mask) != 0)
        faults.push_back({fmt::format("{}/{}/wait/value", pointer, k), fmt::format("{:#x}", step.wait_value),
                          fmt::format("bits of the mask {:#x} only: this wait can never end", *step.wait_mask)});
    }
  std::set<std::uint32_t> codes;
  for (std::size_t k = 0; k < p.alarms.size(); ++k)
    if (!codes.insert(p.alarms[k].code).second)
      faults.push_back({fmt::format("/alarms/{}/code", k), fmt::format("{:#x} for the second time", p.alarms[k].code), "each code once"});
}

}  // namespace

const RegisterField* AxisProfile::written_field(const std::string& field) const noexcept {
  if (field == "control") return &control;
  if (field == "mode") return &mode;
  if (field == "target") return &target;
  if (field == "velocity") return &velocity;
  if (field == "acceleration" && acceleration) return &*acceleration;
  if (field == "watchdog" && watchdog) return &*watchdog;
  return nullptr;
}

std::string AxisProfile::alarm_text(std::uint32_t code) const {
  const auto alarm = std::find_if(alarms.begin(), alarms.end(), [&](const Alarm& a) { return a.code == code; });
  return fmt::format("alarm {:#06x}: {}", code, alarm == alarms.end() ? "not in the profile's list" : alarm->text);
}

AxisProfile axis_profile_from(const Json& document, const std::string& source) {
  const std::string refused = "the axis profile cannot be used";
  if (std::vector<Fault> faults = faults_of(document, Schema::axis_profile, source); !faults.empty())
    throw Error(ErrorKind::input, refused, std::move(faults));
  AxisProfile profile = read(document);
  std::vector<Fault> faults;
  check_fields(profile, faults);
  check_commands(profile, faults);
  for (Fault& fault : faults) fault.where = source + "#" + fault.where;
  if (!faults.empty()) throw Error(ErrorKind::input, refused, std::move(faults));
  return profile;
}

AxisProfile load_axis_profile(const std::string& name_or_path, const std::filesystem::path& folder) {
  if (const std::string_view text = axis_profile_text(name_or_path); !text.empty())
    return axis_profile_from(parse_json(text, name_or_path), name_or_path);
  const std::filesystem::path path = folder / name_or_path;
  return axis_profile_from(parse_json(read_file(path), path.string()), path.string());
}

}  // namespace gonio::acquisition
