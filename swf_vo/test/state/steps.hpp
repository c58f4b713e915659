// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "play.hpp"
#include "recordings.hpp"

namespace swf_vo {

/// Pose of the camera in base_link.
inline const urban_nav_core::Pose kPlace(Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5), Eigen::Vector3d(0.1, 0.0, 1.1));

/// Input of one step.
struct Step {
  urban_nav_core::testing::StereoFrame frame;
  std::vector<urban_nav_core::MotionInput> inputs;
};

/// Frames of a motion with a fault (parseFault), every twentieth repeated; optionally with wheels.
inline std::vector<Step> collectSteps(const std::string& motion, int count, const std::string& fault,
                                      bool wheels = false) {
  const Recording& recording = inTheRoom(motion, 1.0, count);
  urban_nav_core::testing::FaultFilter faults({urban_nav_core::testing::parseFault(fault)}, 1);
  std::vector<Step> result;
  urban_nav_core::StampNs last = 0;
  for (int i = 0; i < count; ++i) {
    const urban_nav_core::testing::StereoFrame& frame = recording.frames[static_cast<std::size_t>(i)];
    const auto arrived = faults.apply(frame);
    if (!arrived) continue;
    Step step{*arrived, {}};
    if (wheels && last > 0) {
      urban_nav_core::MotionInput input;
      input.from = last;
      input.to = frame.stamp;
      input.information.diagonal() << 1e4, 1e4, 0.0, 0.0, 0.0, 1e5;
      step.inputs.push_back(input);
    }
    last = frame.stamp;
    result.push_back(step);
    if (i % 20 == 13) result.push_back(step);
  }
  return result;
}

}  // namespace swf_vo
