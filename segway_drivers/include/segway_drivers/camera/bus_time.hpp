// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "segway_drivers/stream/bytes.hpp"

namespace segway_drivers {

constexpr double kBusTimeWrap = 128.0;  // s

/// Returns the time of an IEEE 1394 bus, s modulo 128, from its register word: 7 bits of seconds, 13 of cycles (125
/// us), 12 of 1/24.576 MHz. The low 4 bits may be a frame count and are ignored (0.65 us). Returns nullopt for cycles
/// or offsets out of range.
std::optional<double> parseBusTime(std::uint32_t word);

/// Returns the host time of an event from its bus time, given the bus time and the host time of one later instant, less
/// than 128 s apart.
TimeNs hostTimeOfBusTime(double event_s, double now_s, TimeNs now);

}  // namespace segway_drivers
