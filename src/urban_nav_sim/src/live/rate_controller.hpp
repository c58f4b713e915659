// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <deque>
#include <optional>
#include <utility>

#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_sim {

/// Wall time at which a measurement of the session is due. A session that is late by less than a second catches up; one
/// that is later continues from there, at the speed of rendering. Wall times are arguments; no clock is read. Not
/// thread-safe.
class RateController {
 public:
  using Wall = std::chrono::steady_clock::time_point;

  /// `rate`: seconds of the session per second of wall time; 0: everything is due at once.
  explicit RateController(double rate) : rate_(rate) {}

  /// Returns the wall time of a measurement. `taken` must not decrease from call to call.
  Wall due(urban_nav_core::StampNs taken, Wall now);
  /// Restarts after a pause: the next measurement is due at once.
  void restart();
  /// Records a published measurement, for factor().
  void passed(urban_nav_core::StampNs taken, Wall now);

  /// Returns the seconds of the session per second of wall time over the last five; nullopt until one second has passed
  /// without a pause.
  std::optional<double> factor() const;
  /// Returns true if the session was late by more than a second and factor() shows it.
  bool isSlow() const;

 private:
  struct Mark {
    Wall wall;
    urban_nav_core::StampNs taken;
  };
  double rate_;
  std::optional<Mark> anchor_;
  std::deque<Mark> marks_;  // newest last, about twenty
  bool slipped_ = false;
};

}  // namespace urban_nav_sim
