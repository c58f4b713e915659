// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "segway_drivers/stream/bytes.hpp"

namespace segway_drivers {

/// Command sent to the base.
struct RmpCommand {
  double velocity = 0.0;   ///< m/s, forward
  double turn_rate = 0.0;  ///< rad/s, to the left
};

/// Limits the velocity commands to the base: the last safeguard before the motors. Zero in these cases: no command for
/// `timeout`; the first `hold` after the start; no message of the base for `silence`, and `hold` after it; an emergency
/// stop until its release; a command that is not finite or beyond ten times the limits. Accelerates within limits from
/// the last command sent, brakes immediately. All times are those of one steady clock. Not thread-safe.
class RmpCommandGuard {
 public:
  struct Limits {
    double velocity = 1.5, turn_rate = 1.5;                 ///< m/s, rad/s
    double acceleration = 1.0, angular_acceleration = 2.0;  ///< m/s^2, rad/s^2
    double timeout = 0.5, hold = 0.5, silence = 0.1;        ///< s
  };
  explicit RmpCommandGuard(const Limits& limits) : limits_(limits) {}

  void setWish(const RmpCommand& wish, TimeNs now);
  /// Reports a message of the base.
  void reportBase(TimeNs now);
  /// Stops until releaseStop().
  void emergencyStop() { stopped_ = true; }
  void releaseStop() { stopped_ = false; }

  /// Returns the command to send now.
  RmpCommand step(TimeNs now);

 private:
  Limits limits_;
  RmpCommand wish_, command_;
  TimeNs wish_time_ = 0, base_time_ = 0, last_step_ = 0, free_from_ = 0;
  bool has_wish_ = false, started_ = false, stopped_ = false;
};

}  // namespace segway_drivers
