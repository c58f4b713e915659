// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_sim/device/device_fault.hpp"

#include <algorithm>
#include <array>

#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_sim {

using urban_nav_core::UserError;

namespace {

constexpr std::array<const char*, 15> kDeviceFaultNames = {"flip",  "garbage", "cut",       "length", "silence",
                                                           "nak",   "late",    "streaming", "baud",   "mode",
                                                           "power", "unplug",  "gap",       "delay",  "clock"};

}  // namespace

const char* toString(DeviceFaultKind kind) { return kDeviceFaultNames[static_cast<std::size_t>(kind)]; }

std::string deviceFaultList() {
  std::string list;
  for (const char* const name : kDeviceFaultNames) list += (list.empty() ? "" : ", ") + std::string(name);
  return list;
}

DeviceFault parseDeviceFault(const std::string& text, const std::string& option) {
  const std::string where = option + " " + text;
  const auto parts = urban_nav_core::splitAt(text, ':');
  if (parts.size() < 3 || parts.size() > 4) throw UserError(where, "not a fault", "KIND:START_S:DURATION_S[:VALUE]");
  const auto* const name = std::find(kDeviceFaultNames.begin(), kDeviceFaultNames.end(), parts[0]);
  if (name == kDeviceFaultNames.end()) throw UserError(where, std::string(parts[0]), deviceFaultList());
  DeviceFault fault;
  fault.kind = static_cast<DeviceFaultKind>(name - kDeviceFaultNames.begin());
  const auto start = urban_nav_core::parseNumber(parts[1]), duration = urban_nav_core::parseNumber(parts[2]);
  if (!start || !duration || *start < 0.0 || *duration <= 0.0)
    throw UserError(where, std::string(parts[1]) + ":" + std::string(parts[2]),
                    "a start from 0 and a duration above 0, s");
  fault.start = *start;
  fault.duration = *duration;
  if (parts.size() == 4) {
    fault.value = urban_nav_core::parseNumber(parts[3]);
    if (!fault.value || *fault.value < 0.0) throw UserError(where, std::string(parts[3]), "a number from 0");
  }
  return fault;
}

const DeviceFault* findDeviceFault(const std::vector<DeviceFault>& faults, DeviceFaultKind kind, double t) {
  const auto found = std::find_if(faults.begin(), faults.end(),
                                  [&](const DeviceFault& each) { return each.kind == kind && each.isActive(t); });
  return found == faults.end() ? nullptr : &*found;
}

}  // namespace urban_nav_sim
