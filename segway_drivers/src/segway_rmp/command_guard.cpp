// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/segway_rmp/command_guard.hpp"

#include <algorithm>
#include <cmath>

namespace segway_drivers {

namespace {

constexpr double kAbsurdFactor = 10.0;

TimeNs nanoseconds(double seconds) { return static_cast<TimeNs>(std::llround(1e9 * seconds)); }

/// Approaches `wish`: immediately towards zero, by at most `step` away from it. A reversal passes through zero.
double approach(double command, double wish, double step) {
  if (command * wish < 0.0) command = 0.0;
  if (std::abs(wish) <= std::abs(command)) return wish;
  return std::clamp(wish, command - step, command + step);
}

}  // namespace

void RmpCommandGuard::setWish(const RmpCommand& wish, TimeNs now) {
  const bool sane = std::abs(wish.velocity) <= kAbsurdFactor * limits_.velocity &&
                    std::abs(wish.turn_rate) <= kAbsurdFactor * limits_.turn_rate;  // false for NaN
  wish_ = sane ? wish : RmpCommand{};
  wish_time_ = now;
  has_wish_ = true;
}

void RmpCommandGuard::reportBase(TimeNs now) { base_time_ = std::max(base_time_, now); }

RmpCommand RmpCommandGuard::step(TimeNs now) {
  if (!started_) {
    started_ = true;
    free_from_ = now + nanoseconds(limits_.hold);
    last_step_ = now;
  }
  const bool silent = base_time_ == 0 || now - base_time_ > nanoseconds(limits_.silence);
  if (silent) free_from_ = now + nanoseconds(limits_.hold);
  const bool wished = has_wish_ && now - wish_time_ < nanoseconds(limits_.timeout);
  if (stopped_ || !wished || now < free_from_) {
    command_ = {};
  } else {
    const double elapsed = std::min(1e-9 * static_cast<double>(now - last_step_), 0.1);
    command_.velocity = approach(command_.velocity, std::clamp(wish_.velocity, -limits_.velocity, limits_.velocity),
                                 limits_.acceleration * elapsed);
    command_.turn_rate =
        approach(command_.turn_rate, std::clamp(wish_.turn_rate, -limits_.turn_rate, limits_.turn_rate),
                 limits_.angular_acceleration * elapsed);
  }
  last_step_ = now;
  return command_;
}

}  // namespace segway_drivers
