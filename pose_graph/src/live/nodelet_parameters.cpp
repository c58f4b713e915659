// SPDX-License-Identifier: BSD-3-Clause
#include "live/nodelet_parameters.hpp"

#include <cstdint>

#include "urban_nav_core/types/frames.hpp"

namespace pose_graph {

namespace frames = urban_nav_core::frames;

using urban_nav_core::Table;

NodeletParameters::NodeletParameters() { nodeletTable().setDefaults(*this); }

// clang-format would put each column on its own line.
// clang-format off
const Table<NodeletParameters>& nodeletTable() {
  using P = NodeletParameters;
  static const Table<NodeletParameters> rows(
      "",
      {
          {"map_frame", &P::map_frame, "", frames::kMap, false, false, {},
           "Frame of the relaxed trajectory; its origin is the first pose of the first session.", "REP-105"},
          {"odom_frame", &P::odom_frame, "", frames::kOdom, false, false, {},
           "Frame of the odometry; the transform from map_frame to it is published.", "REP-105"},
          {"base_frame", &P::base_frame, "", frames::kBaseLink, false, false, {},
           "Frame of the robot, whose poses are the nodes of the graph.", "REP-105"},
          {"publish_tf", &P::publish_tf, "", true, false, true, {},
           "Whether to publish map_frame to odom_frame on /tf, with the stamp of each odometry message.", "REP-105"},
          {"robot", &P::robot, "", "", false, false, {},
           "Name of the robot; with the recording's name and the first stamp it makes the session's id.",
           "docs/architecture.md"},
          {"recording", &P::recording, "", "", false, false, {},
           "Name of the recording, the same on all of the robot's computers.", "docs/architecture.md"},
          {"store", &P::store, "", "", false, false, {},
           "Absolute path of the session store to which the graph is written, committed each second, and from which "
           "it is resumed; empty: none. One writer per file.", "docs/architecture.md"},
          {"queue_size", &P::queue_size, "messages", 20000, 2, 10000000, {},
           "Inputs that may wait while a relaxation runs; beyond that the oldest is dropped and counted.",
           "docs/architecture.md", {"queue"}},
          {"visualization_period", &P::visualization_period, "s", 1.0, 0.05, 3600.0, {},
           "Minimum time between two publications of path and markers.", "", {"picture_period"}},
          {"path_spacing", &P::path_spacing, "m", 1.0, 0.01, 1000.0, {},
           "Distance between poses of the published path.", "", {"picture_spacing"}},
          {"ground", &P::ground, "", true, false, true, {},
           "Whether stereo/ground_plane levels the map without an accelerometer; it is subscribed, and dense stereo "
           "runs, until imu/data arrives.", "section 6.2"},
      });
  return rows;
}
// clang-format on

}  // namespace pose_graph
