// SPDX-License-Identifier: BSD-3-Clause
#include "live/nodelet_parameters.hpp"

#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_live/drain_row.hpp"

namespace scene_labeler {

using urban_nav_core::Table;

NodeletParameters::NodeletParameters() { nodeletTable().setDefaults(*this); }

// clang-format would put each column on its own line.
// clang-format off
const Table<NodeletParameters>& nodeletTable() {
  using P = NodeletParameters;
  static const Table<NodeletParameters> rows(
      "",
      {
          {"base_frame", &P::base_frame, "", urban_nav_core::frames::kBaseLink, false, false, {},
           "Frame of the robot.", "REP-105"},
          {"odom_frame", &P::odom_frame, "", urban_nav_core::frames::kOdom, false, false, {},
           "Frame of the odometry and of the cloud.", "REP-105"},
          {"compressed", &P::compressed, "", true, false, false, {},
           "Image topics are sensor_msgs/CompressedImage; /compressed is appended to their names.",
           "docs/architecture.md"},
          {"always", &P::always, "", false, false, true, {},
           "Returns are labelled even if no topic of the labels has a subscriber.", "docs/architecture.md"},
          {"queue_size", &P::queue_size, "messages", 4000, 2, 1000000, {},
           "Largest number of waiting inputs; beyond it the oldest is dropped and counted.", "docs/architecture.md"},
          urban_nav_live::drainRow(&P::drain_s),
      });
  return rows;
}
// clang-format on

}  // namespace scene_labeler
