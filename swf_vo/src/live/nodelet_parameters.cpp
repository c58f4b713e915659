// SPDX-License-Identifier: BSD-3-Clause
#include "live/nodelet_parameters.hpp"

#include "urban_nav_core/types/frames.hpp"

namespace swf_vo {

using urban_nav_core::Table;

NodeletParameters::NodeletParameters() { nodeletTable().setDefaults(*this); }

// clang-format would put each column on a line of its own.
// clang-format off
const Table<NodeletParameters>& nodeletTable() {
  using P = NodeletParameters;
  static const Table<NodeletParameters> rows(
      "",
      urban_nav_core::withMotionInput(urban_nav_live::withStereoInput<P>(
          {
              {"odom_frame", &P::odom_frame, "", urban_nav_core::frames::kOdom, false, false, {},
               "Frame of the odometry; its origin is the first base_link.", "REP-105"},
              {"publish_tf", &P::publish_tf, "", true, false, true, {},
               "Whether to publish odom_frame to base_frame on /tf.", "REP-105"},
              {"imu_rate", &P::imu_rate, "", false, false, true, {},
               "Whether to publish vo/odometry and tf also between frames, at each message of the gyroscope.",
               "docs/derivations/motion_sensors.md"},
              {"robot", &P::robot, "", "", false, false, {},
               "Name of the robot, part of the session ids.", "docs/architecture.md"},
              {"recording", &P::recording, "", "", false, false, {},
               "Name of the recording, part of the session ids; a second run of it is \"NAME (2)\".",
               "docs/architecture.md"},
          },
          200)));
  return rows;
}
// clang-format on

}  // namespace swf_vo
