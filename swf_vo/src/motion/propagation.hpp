// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "motion/sensor_prediction.hpp"
#include "prediction.hpp"
#include "swf_vo/parameters.hpp"
#include "swf_vo/propagation.hpp"

namespace swf_vo {

/// State of a filter from which poses are propagated. Motion inputs later than the frame are added to a copy of its
/// sensors; the filter receives them with its next frame.
class Propagation::Implementation {
 public:
  /// `newest`: left camera at `stamp`. `velocity`: of base_link in that frame.
  Implementation(const Parameters& parameters, const urban_nav_core::Pose& T_base_camera, Prediction prediction,
                 urban_nav_core::MotionSensors sensors, urban_nav_core::StampNs stamp,
                 const urban_nav_core::PoseWithCovariance& newest, const Velocity& velocity);

  std::optional<PropagatedPose> add(const urban_nav_core::MotionInput& input);

 private:
  /// Motion of the left camera since the anchor, with full information.
  ProcessInput step(urban_nav_core::StampNs to) const;
  Velocity velocity(urban_nav_core::StampNs to) const;
  void moveAnchor(urban_nav_core::StampNs to, const ProcessInput& u,
                  const urban_nav_core::PoseWithCovariance& T_odom_camera);

  double acceleration_, angular_acceleration_;  // m/s^2, rad/s^2
  urban_nav_core::Pose T_base_camera_;
  Prediction prediction_;
  urban_nav_core::MotionSensors sensors_;
  urban_nav_core::StampNs frame_stamp_, anchor_;
  urban_nav_core::PoseWithCovariance T_odom_camera_;  // at the anchor
  Velocity velocity_;                                 // of the frame
};

}  // namespace swf_vo
