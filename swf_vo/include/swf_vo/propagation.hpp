// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>

#include "swf_vo/frame.hpp"
#include "urban_nav_core/types/motion_input.hpp"

namespace swf_vo {

/// Pose of base_link between frames.
struct PropagatedPose {
  urban_nav_core::StampNs stamp = 0;               ///< on the clock of the cameras
  urban_nav_core::PoseWithCovariance T_odom_base;  ///< covariance: of the newest frame and of the motion since
  Velocity velocity;
};

/// Propagates the pose of the newest frame of a filter by motion sensors, at a higher rate than that of the images. The
/// motion is that of the filter's own prediction: rotation by the gyroscope, translation by wheels if they are in use,
/// constant velocity otherwise. Does not influence the filter. Not thread-safe.
class Propagation {
 public:
  class Implementation;
  explicit Propagation(std::unique_ptr<Implementation> implementation);
  ~Propagation();
  Propagation(Propagation&&) noexcept;
  Propagation& operator=(Propagation&&) noexcept;

  /// Adds a motion input that the filter has not received yet. Returns the pose at its end if it is one of the
  /// gyroscope, the gyroscope is in use (MotionEstimates::uses_gyroscope) and consistent with the newest frame, and the
  /// end is later than that frame; nullopt otherwise. Requires the inputs of each sensor in order of time.
  std::optional<PropagatedPose> add(const urban_nav_core::MotionInput& input);

 private:
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace swf_vo
