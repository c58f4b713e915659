// SPDX-License-Identifier: BSD-3-Clause
#include "nodelet_parameters.hpp"

#include <utility>
#include <vector>

#include "urban_nav_core/types/frames.hpp"

namespace loop_metric {

namespace frames = urban_nav_core::frames;

using urban_nav_core::Row;
using urban_nav_core::Table;

NodeletParameters::NodeletParameters() { nodeletTable().setDefaults(*this); }
LocalisationParameters::LocalisationParameters() { localisationTable().setDefaults(*this); }

namespace {

// clang-format would give each of the columns a line.
// clang-format off
/// The rows that both have, behind their own.
template <typename P>
std::vector<Row<P>> withListening(std::vector<Row<P>> own) {
  const std::vector<Row<P>> listening = {
          {"base_frame", &P::base_frame, "", frames::base_link, false, false, {},
           "Frame of the robot, whose poses are meant.", "REP-105"},
          {"images", &P::images, "", "auto", false, false, {"auto", "raw", "rectified"},
           "Whether the images are rectified inside by camera_info, or were before they came; auto: rectified where the topic's name has `rect` in it.",
           "image_proc"},
          {"compressed", &P::compressed, "", false, false, true, {},
           "Whether the image topics are sensor_msgs/CompressedImage.", "section 5"},
          {"queue", &P::queue, "messages", 2000, 2, 1000000, {},
           "Images, scans and poses that may wait; beyond that the oldest is dropped and counted.", "section 5"},
          {"max_lateness", &P::max_lateness, "s", 0.1, 0.0, 10.0, {},
           "How long, by stamps, an image waits for its partner.", "section 3"},
          {"pairing", &P::pairing, "s", 0.005, 0.0, 1.0, {},
           "Largest difference between the stamps of left and right image.", "section 3"},
          {"tf_wait", &P::tf_wait, "s", 1.0, 0.0, 3600.0, {},
           "How long the first images wait for the place of the camera on /tf_static; after that base_frame is taken to be at the left camera.", "REP-103"},
  };
  own.insert(own.end(), listening.begin(), listening.end());
  return own;
}
// clang-format on

}  // namespace

// clang-format off
const Table<NodeletParameters>& nodeletTable() {
  using P = NodeletParameters;
  static const Table<NodeletParameters> rows(
      "",
      withListening<P>({
          {"robot", &P::robot, "", "", false, false, {},
           "Name of the robot; with the recording's name and the first stamp it makes the session's id.", "section 7"},
          {"recording", &P::recording, "", "", false, false, {},
           "Name of the recording, the same on all of the robot's computers.", "section 7"},
          {"store", &P::store, "", "", false, false, {},
           "Absolute path of the session store in which views, scans and odometry are kept, committed each second, and whose earlier sessions candidates may name; "
           "empty: a file in the folder for temporary ones, which goes with the nodelet. One writer a file.", "section 7"},
          {"patience", &P::patience, "s", 10.0, 0.0, 3600.0, {},
           "How long, by stamps, a candidate waits at most until the robot has driven on by what it may need (cloud_way, or view_way); and by the clock where no odometry comes.", "section 4.2"},
      }));
  return rows;
}

const Table<LocalisationParameters>& localisationTable() {
  using P = LocalisationParameters;
  static const Table<LocalisationParameters> rows(
      "localisation",
      withListening<P>({
          {"store", &P::store, "", "", false, false, {},
           "Absolute path of the session store in whose first map the robot is looked for; it is read, and never changed.", "section 7"},
          {"map_frame", &P::map_frame, "", frames::map, false, false, {},
           "Frame of that map; its origin is the first pose of its first session.", "REP-105"},
          {"odom_frame", &P::odom_frame, "", frames::odom, false, false, {},
           "Frame of the odometry, which map_frame is tied to.", "REP-105"},
          {"publish_tf", &P::publish_tf, "", true, false, true, {},
           "Whether to publish map_frame to odom_frame on /tf, with the stamp of each odometry message, from the first time on that the robot is KNOWN.", "REP-105"},
          {"path_spacing", &P::path_spacing, "m", 1.0, 0.01, 1000.0, {},
           "Distance between poses of the published path of the map.", "section 5"},
      }));
  return rows;
}
// clang-format on

}  // namespace loop_metric
