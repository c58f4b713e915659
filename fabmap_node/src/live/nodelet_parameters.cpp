// SPDX-License-Identifier: BSD-3-Clause
#include "live/nodelet_parameters.hpp"

#include <cstdint>

#include "urban_nav_live/drain_row.hpp"

namespace fabmap_node {

using urban_nav_core::Table;

NodeletParameters::NodeletParameters() { nodeletTable().setDefaults(*this); }

// clang-format would put each column on its own line.
// clang-format off
const Table<NodeletParameters>& nodeletTable() {
  using P = NodeletParameters;
  static const Table<NodeletParameters> rows(
      "",
      {
          {"cameras", &P::cameras, "", std::int64_t{0}, std::int64_t{0}, std::int64_t{5}, {},
           "Cameras of the panoramic head, on ladybug/camera0 ... 4; 1: each left image instead; 0: the head, or left "
           "images at keyframes if the head sends none in 3 s.",
           "paper 3"},
          {"compressed", &P::compressed, "", true, false, false, {},
           "Image topics are sensor_msgs/CompressedImage; /compressed is appended to their names.",
           "docs/architecture.md"},
          {"left_compressed", &P::left_compressed, "", false, false, true, {},
           "The same of left images, if cameras = 0.", "docs/architecture.md"},
          {"queue_size", &P::queue_size, "messages", std::int64_t{100}, std::int64_t{5}, std::int64_t{10000}, {},
           "Largest number of waiting images and poses; beyond it the oldest is dropped and counted.",
           "docs/architecture.md"},
          urban_nav_live::drainRow(&P::drain_s),
          {"max_lateness", &P::max_lateness, "s", 0.2, 0.0, 10.0, {},
           "Time by stamps that a panorama waits for missing images.", "docs/architecture.md"},
          {"robot", &P::robot, "", "", false, false, {},
           "Name of the robot; with the name of the recording and the first stamp it makes the id of the session.",
           "docs/files.md"},
          {"recording", &P::recording, "", "", false, false, {},
           "Name of the recording, the same on all computers of the robot.", "docs/files.md"},
          {"map", &P::map, "", "", false, false, {},
           "Absolute path of a session store whose places are in the map from the start, as by ~load. Empty: none.",
           "docs/files.md"},
          {"store", &P::store, "", "", false, false, {},
           "Absolute path of a session store, used by this node only, to which places are written; its previous "
           "places are in the map. Empty: none.",
           "docs/files.md"},
      });
  return rows;
}
// clang-format on

}  // namespace fabmap_node
