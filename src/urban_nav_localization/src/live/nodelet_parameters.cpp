// SPDX-License-Identifier: BSD-3-Clause
#include "live/nodelet_parameters.hpp"

#include "urban_nav_core/types/frames.hpp"

namespace urban_nav_localization {

namespace frames = urban_nav_core::frames;
using urban_nav_core::Table;

NodeletParameters::NodeletParameters() { nodeletTable().setDefaults(*this); }

// clang-format would give each of the columns a line.
// clang-format off
const Table<NodeletParameters>& nodeletTable() {
  using P = NodeletParameters;
  static const Table<NodeletParameters> rows(
      "",
      urban_nav_live::withStereoInput<P>({
          {"store", &P::store, "", "", false, false, {},
           "Absolute path of the session store that holds the map; it is opened for reading only.", "docs/files.md"},
          {"stereo", &P::stereo, "", true, false, true, {},
           "Compare keyframes of the stereo camera with those of the map; false for robots without cameras.",
           "paper 4.1"},
          {"map_frame", &P::map_frame, "", frames::kMap, false, false, {},
           "Frame of the map; its origin is the first pose of its first session.", "REP-105"},
          {"odom_frame", &P::odom_frame, "", frames::kOdom, false, false, {},
           "Frame of the odometry; the transform from map_frame to it is published.", "REP-105"},
          {"publish_tf", &P::publish_tf, "", true, false, true, {},
           "Whether to publish map_frame to odom_frame on /tf, with the stamp of each odometry message, as soon as the "
           "robot has been LOCALIZED.", "REP-105"},
          {"path_spacing", &P::path_spacing, "m", 1.0, 0.01, 1000.0, {},
           "Distance between poses of the published path of the map.", ""},
      }, 2000));
  return rows;
}
// clang-format on

}  // namespace urban_nav_localization
