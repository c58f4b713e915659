// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_sim/fault.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_sim {

using urban_nav_core::UserError;

namespace {

constexpr std::array<FaultKind, 12> kAllKinds = {
    FaultKind::Drop, FaultKind::Freeze, FaultKind::Swap,  FaultKind::Corrupt, FaultKind::Jump, FaultKind::Unplug,
    FaultKind::Nan,  FaultKind::Knock,  FaultKind::Drift, FaultKind::Scale,   FaultKind::Rain, FaultKind::Dark};
constexpr double kLargestTurn = 10.0;  // deg
constexpr const char* kForm = "KIND:SENSOR:START_S:DURATION_S[:VALUE], as in drop:stereo:10:2:0.5";

FaultKind parseKind(std::string_view word, const std::string& where) {
  for (const FaultKind kind : kAllKinds)
    if (word == toString(kind)) return kind;
  throw UserError(where, "fault \"" + std::string(word) + "\"", faultList());
}

double within(std::string_view word, const char* what, double low, double high, const std::string& where) {
  const std::optional<double> number = urban_nav_core::parseNumber(word);
  if (!number || !(*number >= low && *number <= high))
    throw UserError(where, std::string(what) + " \"" + std::string(word) + "\"",
                    urban_nav_core::printNumber(low) + "..." + urban_nav_core::printNumber(high));
  return *number;
}

bool isShare(FaultKind kind) {
  return kind == FaultKind::Drop || kind == FaultKind::Corrupt || kind == FaultKind::Rain || kind == FaultKind::Dark;
}

/// Returns the sensors that may have a fault; empty: any.
std::vector<Sensor> affectedSensors(FaultKind kind) {
  if (kind == FaultKind::Knock) return {Sensor::Stereo, Sensor::Lasers, Sensor::Ladybug};
  if (kind == FaultKind::Scale || kind == FaultKind::Rain || kind == FaultKind::Dark) return {Sensor::Stereo};
  return {};
}

/// Throws UserError with the allowed sensors.
void checkSensor(const Fault& fault, const std::string& where) {
  const std::vector<Sensor> allowed = affectedSensors(fault.kind);
  if (allowed.empty() || std::find(allowed.begin(), allowed.end(), fault.sensor) != allowed.end()) return;
  std::string list;
  for (const Sensor sensor : allowed) list += (list.empty() ? "" : ", ") + std::string(toString(sensor));
  throw UserError(where, std::string(toString(fault.kind)) + " of \"" + toString(fault.sensor) + "\"", list);
}

}  // namespace

const char* toString(FaultKind kind) {
  switch (kind) {
    case FaultKind::Drop: return "drop";
    case FaultKind::Freeze: return "freeze";
    case FaultKind::Swap: return "swap";
    case FaultKind::Corrupt: return "corrupt";
    case FaultKind::Jump: return "jump";
    case FaultKind::Unplug: return "unplug";
    case FaultKind::Nan: return "nan";
    case FaultKind::Knock: return "knock";
    case FaultKind::Drift: return "drift";
    case FaultKind::Scale: return "scale";
    case FaultKind::Rain: return "rain";
    case FaultKind::Dark: return "dark";
  }
  return "";
}

std::string faultList() {
  std::string list;
  for (const FaultKind kind : kAllKinds) list += (list.empty() ? "" : ", ") + std::string(toString(kind));
  return list;
}

Fault parseFault(const std::string& text, const std::string& option) {
  const std::string where = option + " " + text;
  const std::vector<std::string_view> parts = urban_nav_core::splitAt(text, ':');
  Fault fault;
  fault.kind = parseKind(parts[0], where);
  if (parts.size() < 4 || parts.size() > 5) throw UserError(where, "incomplete", kForm);
  fault.sensor = parts[1] == "clock" ? Sensor::Stereo : parseSensor(std::string(parts[1]), where);
  checkSensor(fault, where);
  fault.start = within(parts[2], "start", 0.0, 1e6, where);
  fault.duration = within(parts[3], "duration", 0.0, 1e6, where);
  if (parts.size() == 5) {
    if (isShare(fault.kind)) fault.value = within(parts[4], "share", 0.0, 1.0, where);
    else if (fault.kind == FaultKind::Jump) fault.value = within(parts[4], "jump", -1e6, 1e6, where);
    else if (fault.kind == FaultKind::Knock) fault.value = within(parts[4], "turn", -kLargestTurn, kLargestTurn, where);
    else if (fault.kind == FaultKind::Drift) fault.value = within(parts[4], "drift", -1e3, 1e3, where);
    else if (fault.kind == FaultKind::Scale) fault.value = within(parts[4], "factor", 0.1, 10.0, where);
    else throw UserError(where, std::string(toString(fault.kind)) + " takes no value", kForm);
  }
  return fault;
}

}  // namespace urban_nav_sim
