// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_core/parameters/table.hpp"
#include "urban_nav_sim/session.hpp"

namespace urban_nav_sim {

/// Parameters of the live simulator: the options of `urban_nav simulate`, and of playback. One member per row of
/// simulatorTable().
struct SimulatorParameters {
  std::string world, route;
  int seed, day;
  std::string light;          // as --light
  double duration;            // s
  std::string sensors;        // words of sensorList()
  std::string lidar;          // as --lidar
  std::string with, without;  // defects, see Defects
  std::string fault;          // faults for parseFault()
  double rate;                // seconds of the session per second
  double delay;               // s
  bool paused, exit;
  int threads;
  int queue;  // messages

  SimulatorParameters();
};

const urban_nav_core::Table<SimulatorParameters>& simulatorTable();

/// Throws UserError for an unknown world, route, sensor or fault, naming the key after `where` ("/simulator/") and the
/// valid values.
SessionOptions sessionOptions(const SimulatorParameters& parameters, const std::string& where);

}  // namespace urban_nav_sim
