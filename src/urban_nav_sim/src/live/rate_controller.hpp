// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <deque>
#include <optional>
#include <utility>

#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_sim {

/// Wall time at which a measurement of the session is due. A session that is late by less than a second catches up; one
/// that is later continues from there: its time follows the rendering. Wall times are arguments; no clock is read. Not
/// thread-safe.
class RateController {
 public:
  using Wall = std::chrono::steady_clock::time_point;

  /// `rate`: seconds of the session in a second of the wall; 0: all is due at once.
  explicit RateController(double rate) : rate_(rate) {}

  /// `taken` does not decrease from call to call.
  Wall due(urban_nav_core::StampNs taken, Wall now);
  /// After a pause: what comes next is due at once.
  void restart();
  /// What was due has been published: it counts towards factor().
  void passed(urban_nav_core::StampNs taken, Wall now);

  /// Seconds of the session in a second of the wall over the last five; empty until one has passed without a pause.
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
  std::deque<Mark> marks_;  // newest last, some twenty
  bool slipped_ = false;
};

}  // namespace urban_nav_sim
