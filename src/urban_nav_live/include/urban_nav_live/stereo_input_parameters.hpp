// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "urban_nav_core/parameters/table.hpp"
#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_live/drain_row.hpp"

namespace urban_nav_live {

/// Parameters for receiving a stereo camera, base of those of each nodelet that does. The rows are stereoInputRows();
/// their defaults are set with those of the derived struct.
struct StereoInputParameters {
  std::string base_frame;
  std::string image_type;  // auto, raw, rectified
  bool compressed;
  int queue_size;         // messages
  double max_lateness;    // s
  double sync_tolerance;  // s
  double tf_timeout;      // s
  double drain_s;         // s
};

/// Returns the rows `own` followed by those of StereoInputParameters. `queue_size`: default, messages.
template <typename P>
std::vector<urban_nav_core::Row<P>> withStereoInput(std::vector<urban_nav_core::Row<P>> own, int queue_size) {
  const std::vector<urban_nav_core::Row<P>> rows = {
      {"base_frame",
       &P::base_frame,
       "",
       urban_nav_core::frames::kBaseLink,
       false,
       false,
       {},
       "Frame of the robot.",
       "REP-105"},
      {"image_type",
       &P::image_type,
       "",
       "auto",
       false,
       false,
       {"auto", "raw", "rectified"},
       "Whether images are raw, to be rectified by camera_info, or rectified; auto: determined from the rows of the "
       "first pairs, else rectified if the topic name contains `rect`.",
       "image_proc",
       {"images"}},
      {"compressed",
       &P::compressed,
       "",
       false,
       false,
       true,
       {},
       "Whether the image topics are sensor_msgs/CompressedImage.",
       "docs/architecture.md"},
      {"queue_size",
       &P::queue_size,
       "messages",
       queue_size,
       2,
       1000000,
       {},
       "Largest number of waiting inputs; beyond it the oldest is dropped and counted.",
       "docs/architecture.md",
       {"queue"}},
      {"max_lateness",
       &P::max_lateness,
       "s",
       0.1,
       0.0,
       10.0,
       {},
       "Time, by stamps, that an image waits for its partner and for motion inputs.",
       "docs/conventions.md"},
      {"sync_tolerance",
       &P::sync_tolerance,
       "s",
       0.005,
       0.0,
       1.0,
       {},
       "Largest difference between the stamps of left and right image.",
       "docs/conventions.md",
       {"pairing"}},
      {"tf_timeout",
       &P::tf_timeout,
       "s",
       1.0,
       0.0,
       3600.0,
       {},
       "Time that the first images wait for the pose of the camera on /tf_static; then base_frame is assumed at the "
       "left camera, with a warning, until the pose arrives and a new session begins.",
       "REP-103",
       {"tf_wait"}},
      drainRow<P>(&P::drain_s)};
  own.insert(own.end(), rows.begin(), rows.end());
  return own;
}

}  // namespace urban_nav_live
