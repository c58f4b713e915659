// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "front_end/front_end.hpp"
#include "swf_vo/frame.hpp"
#include "urban_nav_core/io/archive.hpp"
#include "window/window.hpp"

namespace swf_vo {

/// Converts estimates of the left camera in the window to the stage's output in base_link, in the convention of
/// docs/conventions.md.
class Output {
 public:
  explicit Output(const urban_nav_core::Pose& T_base_camera);

  /// `u`: prediction of the process model for the step to this frame.
  const Frame& write(FrameId frame, urban_nav_core::StampNs stamp, const urban_nav_core::Status& status,
                     const Window& window, const ProcessInput& u, const FrontEndResult* seen,
                     const UpdateReport& update);
  /// Returns the output for a frame rejected because of its stamp, with the previous pose.
  /// Sets the estimates of motion sensors in the newest frame.
  void setMotion(const MotionEstimates& motion) { frame_.motion = motion; }
  const Frame& refused(urban_nav_core::StampNs stamp);
  /// Velocity of the newest accepted frame.
  const Velocity& newestVelocity() const { return frame_.velocity; }
  Settled settle(const SettledPose& pose);
  /// `window`: contains the frames that are still to settle.
  void archive(urban_nav_core::Archive& archive, const Window& window);

 private:
  struct Waiting {  // data of a frame, kept until it settles
    FrameId frame = 0;
    urban_nav_core::StampNs stamp = 0;
    urban_nav_core::Status status;
    void archive(urban_nav_core::Archive& archive);
  };
  Velocity velocity(FrameId frame, urban_nav_core::StampNs stamp, bool lost, const Window& window,
                    const ProcessInput& u) const;
  void list(const Window& window, const FrontEndResult* seen);
  int computeAge(LandmarkId landmark, FrameId frame);

  urban_nav_core::Pose T_base_camera_, T_camera_base_;
  Frame frame_;
  std::vector<Waiting> waiting_;  // oldest first
  urban_nav_core::StampNs last_settled_ = 0;
  bool any_settled_ = false;
  urban_nav_core::Pose last_T_odom_camera_;  // previous frame, filtered
  urban_nav_core::Matrix6d step_covariance_ =
      urban_nav_core::Matrix6d::Zero();               // last settled step of base_link; zero: none yet
  std::vector<std::pair<LandmarkId, FrameId>> born_;  // sorted by landmark: ids only grow
};

}  // namespace swf_vo
