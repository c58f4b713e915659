// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "fabmap_node/decision/travelled_distance.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"
#include "urban_nav_live/time_jump.hpp"

namespace fabmap_node {

/// Odometry of the session that observations belong to. Images and odometry are topics of their own: when a recording
/// begins again, their stamps jump back at different moments. Not thread-safe.
class SessionOdometry {
 public:
  /// Adds a pose. Stamps that jump back belong to the next session.
  void add(const urban_nav_core::StampedPose& T_odom_base);
  /// Stamps of observations have jumped back: those that follow belong to the next session.
  void beginNextSession();
  /// Odometry has begun a session without a jump back: what was driven before is forgotten.
  void restart() { current_ = Part(); }
  /// Returns true if poses of the next session have arrived.
  bool isAhead() const { return next_.has_value(); }

  /// Returns the stamp of the first pose of the session; nullopt before it.
  std::optional<urban_nav_core::StampNs> start() const { return current_.start; }
  /// Returns the newest stamp of odometry; nullopt before it.
  std::optional<urban_nav_core::StampNs> newest() const { return time_.newest(); }
  /// Returns the distance driven in the session up to a stamp, m.
  double travelled(urban_nav_core::StampNs stamp) const { return current_.travelled.at(stamp); }

 private:
  struct Part {
    std::optional<urban_nav_core::StampNs> start;
    TravelledDistance travelled;
  };

  urban_nav_live::TimeJumpDetector time_;
  Part current_;
  std::optional<Part> next_;  // stamps of odometry have jumped back, those of observations have not
  bool is_late_ = false;      // stamps of observations have jumped back, those of odometry have not
};

}  // namespace fabmap_node
