// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "urban_nav_core/types/closure.hpp"
#include "urban_nav_core/types/point_cloud.hpp"
#include "urban_nav_core/types/pose_with_covariance.hpp"
#include "urban_nav_registration/keyframe/keyframe.hpp"

namespace loop_metric {

/// Stored keyframe near a pose of the same session.
struct NearbyKeyframe {
  urban_nav_core::PoseRef at;
  urban_nav_core::PoseWithCovariance T_place_keyframe;  ///< between base_links; the covariance may be zero
  double path_offset = 0.0;                             ///< m driven from the pose to the keyframe; negative: before
                                                        ///< the pose
};

/// Stored data of the places of candidates, requested by LoopMetric as needed; implemented for recordings and stores.
class PlaceData {
 public:
  virtual ~PlaceData() = default;

  /// Returns whether odometry covers the stamp. Otherwise sets `why` to the reason, for the user.
  virtual bool knows(const urban_nav_core::PoseRef& at, std::string& why) const = 0;
  /// Returns the keyframes within `distance` m of path from the pose, in order of time.
  virtual std::vector<NearbyKeyframe> views(const urban_nav_core::PoseRef& at, double distance) const = 0;
  /// Returns a keyframe; without image and points if it is not stored. Throws DataError if the stored data is damaged.
  virtual urban_nav_registration::Keyframe keyframe(const urban_nav_core::PoseRef& at) const = 0;
  /// Returns the points of the lasers from `distance` m before the pose to `distance` m after it, in base_link at the
  /// pose; empty without laser data.
  virtual urban_nav_core::PointCloud cloud(const urban_nav_core::PoseRef& at, double distance) const = 0;
  /// Returns the deformation of that cloud by the drift of odometry, m.
  virtual double deformationSigma(const urban_nav_core::PoseRef& at, double distance) const = 0;
  /// T_a_b by odometry, and the length of the path in between.
  struct OdometryPath {
    urban_nav_core::PoseWithCovariance T_a_b;
    double length = 0.0;  ///< m
  };
  virtual std::optional<OdometryPath> between(const urban_nav_core::PoseRef& a,
                                              const urban_nav_core::PoseRef& b) const = 0;
};

}  // namespace loop_metric
