// SPDX-License-Identifier: BSD-3-Clause
#include "live/nodelet_parameters.hpp"

namespace segway_drivers {

using urban_nav_core::Table;

NodeletParameters::NodeletParameters() { nodeletTable().setDefaults(*this); }

// clang-format would give each of the columns a line.
// clang-format off
const Table<NodeletParameters>& nodeletTable() {
  using P = NodeletParameters;
  static const Table<NodeletParameters> rows(
      "",
      {
          {"port", &P::port, "", "", false, false, {},
           "Serial port, best by /dev/serial/by-id or a udev link; HOST:PORT of gpsd; a CAN interface for the base; "
           "the GUID of a camera, empty for the only one, or the path of a recording of urban_nav simulate that feeds "
           "a simulated camera. It may be missing at the start.", ""},
          {"frame", &P::frame, "", "", false, false, {},
           "Frame of the measurements; empty: that of the device (laser_left in the namespace laser_left, imu_link, "
           "odom, gps_link).", "REP-105"},
          {"base_frame", &P::base_frame, "", "base_link", false, false, {},
           "Frame of the robot, for the odometry of the base.", "REP-105"},
          {"publish_tf", &P::publish_tf, "", false, false, true, {},
           "Whether the base publishes its odometry on /tf; visual odometry does so by default.", "REP-105"},
          {"session_begin", &P::session_begin, "", "", false, false, {},
           "File by which the simulated devices of a launch begin their sessions together, new for each launch; "
           "empty: the session of a camera begins when it is opened.", ""},
          {"session_held", &P::session_held, "", false, false, true, {},
           "Whether a simulated camera is absent before another process has written the begin, ns of the steady "
           "clock, to that file.", ""},
          {"paced_by", &P::paced_by, "", "", false, false, {},
           "Topic of urban_nav_msgs/VoStatistics that paces a simulated camera: a frame is exposed when odometry has "
           "taken all but the newest ten; empty: frames come at the times of the recording.", ""},
          {"queue", &P::queue, "messages", 1000, 10, 100000, {},
           "Messages that may wait for publication; beyond that new ones are dropped and counted. Reading never waits.",
           ""},
          {"image_queue", &P::image_queue, "images", 10, 1, 100000, {},
           "Images of a camera that may wait for a subscriber; beyond that the oldest are dropped.", ""},
      });
  return rows;
}
// clang-format on

}  // namespace segway_drivers
