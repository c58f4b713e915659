// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "front_end/front_end.hpp"
#include "swf_vo/frame.hpp"
#include "urban_nav_core/io/archive.hpp"
#include "window/window.hpp"

namespace swf_vo {

/// Turns what the window knows of the left camera into what leaves the stage of base_link, in the convention of
/// docs/conventions.md.
class Output {
 public:
  explicit Output(const urban_nav_core::Pose& T_base_camera);

  /// `u`: what the process model said of the step to this frame.
  const Frame& write(FrameId frame, urban_nav_core::StampNs stamp, const urban_nav_core::Status& status,
                     const Window& window, const ProcessInput& u, const FrontEndResult* seen,
                     const UpdateReport& update);
  /// A frame that was not accepted because of its stamp: the last pose again.
  /// Puts what is known of motion sensors into the frame that was written last.
  void setMotion(const MotionEstimates& motion) { frame_.motion = motion; }
  const Frame& refused(urban_nav_core::StampNs stamp);
  Settled settle(const SettledPose& pose);
  /// `window`: whose frames are to settle.
  void archive(urban_nav_core::Archive& archive, const Window& window);

 private:
  struct Waiting {  // what a settled frame keeps from the time when it came
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
  urban_nav_core::Pose last_T_odom_camera_;  // of the frame before, as it was known when it came
  urban_nav_core::Matrix6d step_covariance_ =
      urban_nav_core::Matrix6d::Zero();               // of the last settled step of base_link; zero: none yet
  std::vector<std::pair<LandmarkId, FrameId>> born_;  // sorted by landmark: ids only grow
};

}  // namespace swf_vo
