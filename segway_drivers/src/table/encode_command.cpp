// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/table/encode_command.hpp"

#include <functional>

#include "segway_drivers/lms291/commands.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/types/error.hpp"

namespace segway_drivers {

using urban_nav_core::UserError;

namespace {

using Words = std::vector<std::string>;

/// A command of a kind: its name, its arguments as the help names them, and its encoder.
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

const std::vector<CommandEncoder>& commandEncoders() {
  static const std::vector<CommandEncoder> encoders = [] {
    std::vector<CommandEncoder> all;
    for (const auto& of_kind : {lmsEncoders()}) all.insert(all.end(), of_kind.begin(), of_kind.end());
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
