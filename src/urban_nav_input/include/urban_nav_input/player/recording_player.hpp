// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace urban_nav_input {

/// Options of playRecording(), with the names of `rosbag play`.
struct PlayerOptions {
  std::string path;
  double rate = 1.0;    ///< times real time
  double start = 0.0;   ///< s after the first message; the last previous message of each latched topic is sent first
  double delay = 0.2;   ///< s for subscribers to connect before the first message
  bool clock = false;   ///< publishes /clock a hundred times a second
  bool loop = false;    ///< repeats endlessly
  bool paused = false;  ///< waits at the first message
};

/// Publishes the messages of a recording of any storage on their topics at the times of receipt. Omits messages that
/// cannot be decoded, with a warning. The service ~pause_playback begins and ends a pause. Returns at the end of
/// the recording, or when ROS shuts down. Requires a ROS node. Throws UserError or DataError for a recording that
/// cannot be read.
void playRecording(const PlayerOptions& options);

}  // namespace urban_nav_input
