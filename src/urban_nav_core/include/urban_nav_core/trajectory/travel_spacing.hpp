// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_core {

class Archive;

/// Selects data of a sensor by the motion of the robot: the first, then one after each distance or turn, and one every
/// ten seconds at rest.
class TravelSpacing {
 public:
  struct Spacing {
    double distance;  ///< m
    double angle;     ///< rad
  };

  explicit TravelSpacing(Spacing spacing = {0.0, 0.0}) : spacing_(spacing) {}

  void setSpacing(Spacing spacing) { spacing_ = spacing; }
  bool any() const { return any_; }
  /// Returns whether data are selected, which then are the last ones. `T_odom_base`: newest pose; nullopt: none yet.
  bool takes(StampNs stamp, const std::optional<Pose>& T_odom_base);

  /// Reads or writes the state, without the spacing.
  void archive(Archive& archive);

 private:
  Spacing spacing_;
  bool any_ = false;
  StampNs stamp_ = 0;                // of the last selected data
  std::optional<Pose> T_odom_base_;  // then
};

/// Spacing of sweeps of 3D LiDARs in a store: neighbours overlap, and their rings fill each other's gaps.
constexpr TravelSpacing::Spacing kSweepSpacing{0.25, 0.1};

}  // namespace urban_nav_core
