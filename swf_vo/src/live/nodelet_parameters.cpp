// SPDX-License-Identifier: BSD-3-Clause
#include "live/nodelet_parameters.hpp"

#include <cstdint>

#include "urban_nav_core/types/frames.hpp"

namespace swf_vo {

using urban_nav_core::Table;

NodeletParameters::NodeletParameters() { nodeletTable().setDefaults(*this); }

// clang-format would give each of the columns a line.
// clang-format off
const Table<NodeletParameters>& nodeletTable() {
  using P = NodeletParameters;
  static const Table<NodeletParameters> rows(
      "",
      {
          {"odom_frame", &P::odom_frame, "", urban_nav_core::frames::odom, false, false, {},
           "Frame in which the odometry is given; its origin is the first base_link.", "REP-105"},
          {"base_frame", &P::base_frame, "", urban_nav_core::frames::base_link, false, false, {},
           "Frame of the robot, whose motion is estimated.", "REP-105"},
          {"publish_tf", &P::publish_tf, "", true, false, true, {},
           "Whether to publish odom_frame to base_frame on /tf.", "REP-105"},
          {"images", &P::images, "", "auto", false, false, {"auto", "raw", "rectified"},
           "Whether the images are rectified inside by camera_info, or were before they came; auto: rectified where "
           "the topic's name has `rect` in it.",
           "image_proc"},
          {"compressed", &P::compressed, "", false, false, true, {},
           "Whether the image topics are sensor_msgs/CompressedImage.", ""},
          {"queue", &P::queue, "messages", 200, 2, 100000, {},
           "Inputs that may wait for the filter; beyond that the oldest is dropped and counted.", ""},
          {"max_lateness", &P::max_lateness, "s", 0.1, 0.0, 10.0, {},
           "How long, by stamps, an image waits for its partner and for motion inputs. Nothing waits where all came.",
           ""},
          {"pairing", &P::pairing, "s", 0.005, 0.0, 1.0, {},
           "Largest difference between the stamps of left and right image.", ""},
          {"tf_wait", &P::tf_wait, "s", 1.0, 0.0, 3600.0, {},
           "How long the first images wait for the place of the camera on /tf_static; after that base_frame is taken "
           "to be at the left camera.",
           "REP-103"},
      });
  return rows;
}
// clang-format on

}  // namespace swf_vo
