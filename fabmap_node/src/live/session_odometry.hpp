// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "fabmap_node/decision/travelled_distance.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"
#include "urban_nav_live/time_jump.hpp"

namespace fabmap_node {

/// Odometry of the session of the observations. Images and odometry are separate topics: when a recording restarts,
/// their stamps jump back at different moments. Not thread-safe.
class SessionOdometry {
 public:
  /// Adds a pose. Stamps that jump back belong to the next session.
  void add(const urban_nav_core::StampedPose& T_odom_base);
  /// Begins the next session after stamps of observations have jumped back.
  void beginNextSession();
  /// Drops the distance travelled so far, after odometry has begun a session without a backward jump.
  void restart() { current_ = Part(); }
  /// Returns true if poses of the next session have arrived.
  bool isAhead() const { return next_.has_value(); }

  /// Returns the stamp of the first pose of the session; nullopt without poses.
  std::optional<urban_nav_core::StampNs> start() const { return current_.start; }
  /// Returns the newest stamp of odometry; nullopt without poses.
  std::optional<urban_nav_core::StampNs> newest() const { return time_.newest(); }
  /// Returns the distance travelled in the session up to a stamp, m.
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
