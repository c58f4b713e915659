// SPDX-License-Identifier: BSD-3-Clause
#include "live/nodelet_parameters.hpp"

#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_live/drain_row.hpp"

namespace laser_mapper {

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
          {"map_frame", &P::map_frame, "", "map", false, false, {},
           "Frame of the cloud; `odom` without a pose graph.", "REP-105"},
          {"period", &P::period, "s", 2.0, 0.1, 3600.0, {},
           "Minimum time between two clouds; rendering takes at most a quarter of the time.", "docs/architecture.md"},
          {"tile_bandwidth", &P::tile_bandwidth, "MB/s", 2.0, 0.01, 10000.0, {},
           "Mean data rate of map/tiles, and of layers for planners; further changes wait.",
           "docs/architecture.md"},
          {"layer_radius", &P::layer_radius, "m", 50.0, 5.0, 1000.0, {},
           "Distance to which layers for planners follow the path.",
           "docs/architecture.md"},
          {"live_constraints", &P::live_constraints, "", false, false, false, {},
           "Publish planes measured by two passes on map/constraints, for the pose graph; the search takes at most a "
           "quarter of the time.",
           "docs/methods/laser_mapper.md"},
          {"depth_cameras", &P::depth_cameras, "cameras", 1, 0, 4, {},
           "Depth cameras: topics depth0, depth1, ...", "docs/methods/laser_mapper.md"},
          {"compressed_depth", &P::compressed_depth, "", false, false, false, {},
           "Depth images of compressed_depth_image_transport.", "image_transport"},
          {"queue_size", &P::queue_size, "messages", 4000, 2, 1000000, {},
           "Largest number of waiting inputs; beyond it the oldest is dropped and counted.", "docs/architecture.md"},
          urban_nav_live::drainRow(&P::drain_s),
      });
  return rows;
}
// clang-format on

}  // namespace laser_mapper
