// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/stereo_rectify_parameters.hpp"

#include <cstdint>

#include "urban_nav_live/drain_row.hpp"

namespace urban_nav_ros {

using urban_nav_core::Table;

StereoRectifyParameters::StereoRectifyParameters() { stereoRectifyTable().setDefaults(*this); }

// clang-format would put each column on its own line.
// clang-format off
const Table<StereoRectifyParameters>& stereoRectifyTable() {
  using P = StereoRectifyParameters;
  static const Table<StereoRectifyParameters> rows(
      "",
      {
          {"image_type", &P::image_type, "", "auto", false, false, {"auto", "raw", "rectified"},
           "Whether images are raw, to be rectified by camera_info, or rectified; auto: determined from the rows of "
           "the first pairs, else rectified if the topic name contains `rect`.",
           "image_proc"},
          {"compressed", &P::compressed, "", false, false, true, {},
           "Whether the image topics are sensor_msgs/CompressedImage.", "docs/architecture.md"},
          {"queue_size", &P::queue_size, "messages", 200, 2, 1000000, {},
           "Largest number of waiting messages; beyond it the oldest is dropped and counted.", "docs/architecture.md"},
          urban_nav_live::drainRow(&P::drain_s),
      });
  return rows;
}
// clang-format on

}  // namespace urban_nav_ros
