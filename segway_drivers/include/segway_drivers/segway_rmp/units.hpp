// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>

#include "segway_drivers/segway_rmp/can_frame.hpp"

namespace segway_drivers {

/// Counts of an RMP200 (and RMP400) per unit.
struct RmpUnits {
  double per_degree = 7.8;           ///< angles and rates
  double per_mps = 332.0;            ///< wheel speeds and velocity commands
  double per_metre = 33215.0;        ///< travel
  double per_revolution = 112644.0;  ///< yaw travel
  double per_newton_metre = 1094.0;  ///< motor torque
};

/// Returns the quantities of a message in the order of its words, SI units (two for wheel travel and for forward and
/// yaw travel), or nullopt for other identifiers. 0401: pitch, pitch rate, roll, roll rate. 0402: left and right wheel
/// speed, yaw rate, servo frames in s. 0403: left and right travel. 0404: forward and yaw travel. 0405: left and right
/// torque. 0406: mode, gain schedule, voltages of interface and base battery. 0407: velocity and turn command in force,
/// the latter as a share of full. 0400 and 0680: none.
std::optional<std::array<std::optional<double>, 4>> decodeRmpValues(const CanFrame& frame, const RmpUnits& units = {});

/// Returns the motion command. Values are rounded and saturate at 1176 and 1024 counts; non-finite values give 0.
CanFrame makeRmpVelocity(double velocity, double turn_rate, const RmpUnits& units = {});

/// Configuration commands; the message contains the current velocity command.
enum class RmpConfiguration : std::uint16_t { OperatingMode = 0x10, ResetIntegrators = 0x32 };
CanFrame makeRmpConfiguration(const CanFrame& velocity, RmpConfiguration command, std::uint16_t argument);

}  // namespace segway_drivers
