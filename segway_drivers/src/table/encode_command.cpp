// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/table/encode_command.hpp"

#include <array>
#include <functional>

#include "segway_drivers/gps/nmea.hpp"
#include "segway_drivers/lms291/commands.hpp"
#include "segway_drivers/segway_rmp/units.hpp"
#include "segway_drivers/xsens_mti/message.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/types/error.hpp"

namespace segway_drivers {

using urban_nav_core::UserError;

namespace {

using Words = std::vector<std::string>;

/// A command of a kind: name, arguments as in the help text, and encoder.
struct CommandEncoder {
  std::string kind, name, arguments;
  std::size_t count;  // of arguments
  std::function<Bytes(const Words& arguments)> encode;
};

std::vector<CommandEncoder> lmsEncoders() {
  const auto plain = [](const std::string& name, Bytes (*command)()) {
    return CommandEncoder{"lms291", name, "", 0, [command](const Words&) { return command(); }};
  };
  return {
      plain("stop", lmsStopCommand),
      plain("stream_all", lmsStreamAllCommand),
      {"lms291", "stream_ranges_reflectivities", "", 0, [](const Words&) { return lmsStreamReflectivitiesCommand(); }},
      plain("poll", lmsPollCommand),
      plain("status", lmsStatusCommand),
      plain("errors", lmsErrorsCommand),
      plain("type", lmsTypeCommand),
      plain("configuration", lmsConfigurationCommand),
      plain("installation", lmsInstallationCommand),
      {"lms291", "baud", " RATE", 1,
       [](const Words& words) {
         const auto rate = urban_nav_core::parseInteger(words[0]);
         const auto bytes =
             rate && *rate > 0 && *rate < 1000000 ? lmsBaudCommand(static_cast<int>(*rate)) : std::nullopt;
         if (!bytes) throw UserError("baud", words[0], "9600, 19200, 38400, 500000");
         return *bytes;
       }},
      plain("reset", lmsResetCommand)};
}

std::int64_t integerArgument(const std::string& name, const std::string& text, std::int64_t high) {
  const bool hexadecimal = text.size() > 2 && text[0] == '0' && (text[1] == 'x' || text[1] == 'X');
  std::optional<std::int64_t> value;
  if (hexadecimal && text.size() <= 10) {
    const auto bytes = parseHex(std::string(10 - text.size(), '0') + text.substr(2));
    if (bytes) value = bigWord32(bytes->data());
  } else {
    value = urban_nav_core::parseInteger(text);
  }
  if (!value || *value < 0 || *value > high) throw UserError(name, text, "0..." + std::to_string(high) + ", or 0x...");
  return *value;
}

std::vector<CommandEncoder> mtiEncoders() {
  const auto plain = [](const std::string& name, Bytes (*command)()) {
    return CommandEncoder{"xsens_mti", name, "", 0, [command](const Words&) { return command(); }};
  };
  return {plain("go_to_config", mtiGoToConfigCommand),
          plain("go_to_measurement", mtiGoToMeasurementCommand),
          plain("device_id", mtiDeviceIdCommand),
          {"xsens_mti", "output_mode", " WORD", 1,
           [](const Words& words) {
             return mtiOutputModeCommand(static_cast<std::uint16_t>(integerArgument("output_mode", words[0], 0xFFFF)));
           }},
          {"xsens_mti", "output_settings", " WORD", 1,
           [](const Words& words) {
             return mtiOutputSettingsCommand(
                 static_cast<std::uint32_t>(integerArgument("output_settings", words[0], 0xFFFFFFFF)));
           }},
          {"xsens_mti", "period", " COUNTS", 1,
           [](const Words& words) {
             return mtiPeriodCommand(static_cast<std::uint16_t>(integerArgument("period", words[0], 0xFFFF)));
           }},
          plain("reset", mtiResetCommand)};
}

Bytes encodeRmpVelocity(const Words& words) {
  const auto velocity = urban_nav_core::parseNumber(words[0]), turn_rate = urban_nav_core::parseNumber(words[1]);
  if (!velocity || !turn_rate) throw UserError("velocity", words[0] + " " + words[1], "two numbers, m/s and rad/s");
  return makeRmpPacket(makeRmpVelocity(*velocity, *turn_rate));
}

Bytes encodeRmpMode(const Words& words) {
  if (words[0] != "tractor" && words[0] != "balance") throw UserError("mode", words[0], "tractor, balance");
  const std::uint16_t mode = words[0] == "tractor" ? 1 : 2;
  return makeRmpPacket(makeRmpConfiguration(makeRmpVelocity(0, 0), RmpConfiguration::OperatingMode, mode));
}

/// Encodes one packet per integrator, since the base does not accept a combined one.
Bytes encodeRmpReset(const Words&) {
  Bytes all;
  for (const std::uint16_t integrator : std::array<std::uint16_t, 4>{1, 2, 4, 8}) {
    const Bytes packet =
        makeRmpPacket(makeRmpConfiguration(makeRmpVelocity(0, 0), RmpConfiguration::ResetIntegrators, integrator));
    all.insert(all.end(), packet.begin(), packet.end());
  }
  return all;
}

std::vector<CommandEncoder> rmpEncoders() {
  return {{"segway_rmp", "velocity", " MPS RADPS", 2, encodeRmpVelocity},
          {"segway_rmp", "mode", " tractor|balance", 1, encodeRmpMode},
          {"segway_rmp", "reset_integrators", "", 0, encodeRmpReset}};
}

std::vector<CommandEncoder> gpsEncoders() {
  return {{"gps", "garmin_off", "", 0, [](const Words&) { return makeNmeaSentence("PGRMO,,2"); }},
          {"gps", "garmin_on", " SENTENCE", 1, [](const Words& words) {
             const bool plain =
                 words[0].size() == 5 && words[0].find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ") == std::string::npos;
             if (!plain) throw UserError("garmin_on", words[0], "a sentence such as GPGGA");
             return makeNmeaSentence("PGRMO," + words[0] + ",1");
           }}};
}

const std::vector<CommandEncoder>& commandEncoders() {
  static const std::vector<CommandEncoder> encoders = [] {
    std::vector<CommandEncoder> all;
    for (const auto& of_kind : {lmsEncoders(), mtiEncoders(), rmpEncoders(), gpsEncoders()})
      all.insert(all.end(), of_kind.begin(), of_kind.end());
    return all;
  }();
  return encoders;
}

std::string listCommands(const std::string& kind) {
  std::string list;
  for (const CommandEncoder& each : commandEncoders())
    if (each.kind == kind) list += (list.empty() ? "" : ", ") + each.name + each.arguments;
  return list;
}

std::string listEncodableKinds() {
  std::string list, last;
  for (const CommandEncoder& each : commandEncoders()) {
    if (each.kind != last) list += (list.empty() ? "" : ", ") + each.kind;
    last = each.kind;
  }
  return list;
}

}  // namespace

Bytes encodeCommand(const std::string& kind, const std::vector<std::string>& words) {
  const std::string commands = listCommands(kind);
  if (commands.empty()) throw UserError("KIND", kind, listEncodableKinds());
  if (words.empty()) throw UserError("COMMAND", "missing", commands);
  for (const CommandEncoder& each : commandEncoders()) {
    if (each.kind != kind || each.name != words.front()) continue;
    const Words arguments(words.begin() + 1, words.end());
    if (arguments.size() != each.count)
      throw UserError(each.name, std::to_string(arguments.size()) + " arguments", each.name + each.arguments);
    return each.encode(arguments);
  }
  throw UserError("COMMAND", words.front(), commands);
}

}  // namespace segway_drivers
