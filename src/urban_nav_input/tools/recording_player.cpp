// SPDX-License-Identifier: BSD-3-Clause
// recording_player: `rosbag play` for recordings of any storage.
#include <ros/ros.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "urban_nav_core/io/printable.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/player/recording_player.hpp"

int main(int argc, char** argv) {
  ros::init(argc, argv, "player");
  urban_nav_input::PlayerOptions options;
  CLI::App app("Plays a recording: a ROS 1 bag, MCAP, .db3 or a folder of rosbag2.");
  app.add_option("RECORDING", options.path, "file or folder")->required();
  app.add_option("-r,--rate", options.rate, "times real time")->check(CLI::Range(1e-3, 1e3));
  app.add_option("-s,--start", options.start, "s to skip at the beginning")->check(CLI::NonNegativeNumber);
  app.add_option("-d,--delay", options.delay, "s that subscribers have to connect")->check(CLI::NonNegativeNumber);
  app.add_flag("--clock", options.clock, "publish /clock");
  app.add_flag("-l,--loop", options.loop, "again from the beginning, without end");
  app.add_flag("--pause", options.paused, "wait at the first message for the service ~pause_playback");
  app.add_flag("-q,--quiet", "for command lines of rosbag play");
  CLI11_PARSE(app, argc, argv);
  try {
    urban_nav_input::playRecording(options);
  } catch (const urban_nav_core::Error& error) {
    std::fprintf(stderr, "recording_player: %s\n", urban_nav_core::printable(error.what()).c_str());
    return 1;
  }
  return 0;
}
