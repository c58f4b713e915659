// SPDX-License-Identifier: BSD-3-Clause
#include "live/nodelet_parameters.hpp"

#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_live/drain_row.hpp"

namespace laser_odometry {

using urban_nav_core::Table;

NodeletParameters::NodeletParameters() { nodeletTable().setDefaults(*this); }

// clang-format would put each column on a separate line.
// clang-format off
const Table<NodeletParameters>& nodeletTable() {
  using P = NodeletParameters;
  static const Table<NodeletParameters> rows(
      "",
      urban_nav_core::withMotionInput<P>({
          {"base_frame", &P::base_frame, "", urban_nav_core::frames::kBaseLink, false, false, {},
           "Frame of the robot.", "REP-105"},
          {"odom_frame", &P::odom_frame, "", urban_nav_core::frames::kOdom, false, false, {},
           "Frame of the odometry; its origin is the first base_link.", "REP-105"},
          {"publish_tf", &P::publish_tf, "", false, false, true, {},
           "Whether to publish odom_frame to base_frame on /tf: only if this is the robot's odometry.",
           "REP-105"},
          {"robot", &P::robot, "", "", false, false, {},
           "Name of the robot, part of the session ids.", "docs/architecture.md"},
          {"recording", &P::recording, "", "", false, false, {},
           "Name of the recording, part of the session ids; a second run of it is \"NAME (2)\".",
           "docs/architecture.md"},
          {"planar", &P::planar, "", false, false, true, {},
           "Whether the sensor is a horizontal planar laser, on scan.",
           "docs/architecture.md"},
          {"deskewed", &P::deskewed, "", false, false, true, {},
           "Whether the driver already compensates the motion within a sweep.", "docs/architecture.md"},
          {"queue_size", &P::queue_size, "messages", std::int64_t{20}, std::int64_t{2}, std::int64_t{1000000}, {},
           "Inputs that may wait; beyond that the oldest is dropped and counted.", "docs/architecture.md"},
          {"max_lateness", &P::max_lateness, "s", 0.1, 0.0, 10.0, {},
           "How much later than a sweep messages of IMU and wheels may arrive, by stamps.", "docs/architecture.md"},
          urban_nav_live::drainRow(&P::drain_s),
      }));
  return rows;
}
// clang-format on

}  // namespace laser_odometry
