// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_core/parameters/table.hpp"
#include "urban_nav_sim/session.hpp"

namespace urban_nav_sim {

/// Parameters of the live simulator: the options of `urban_nav simulate`, and how it is to run. One member per row of
/// simulatorTable().
struct SimulatorParameters {
  std::string world, route;
  int seed, day;
  double duration;            // s
  std::string sensors;        // words of sensorList()
  std::string lidar;          // as --lidar takes it
  std::string with, without;  // defects as Defects takes them
  std::string fault;          // faults as parseFault takes them
  double rate;                // seconds of the session in a second
  double delay;               // s
  bool paused, exit;
  int threads;
  int queue;  // messages

  SimulatorParameters();
};

const urban_nav_core::Table<SimulatorParameters>& simulatorTable();

/// Throws UserError for a world, route, sensor or fault that there is not, naming the key after `where` ("/simulator/")
/// and what there is.
SessionOptions sessionOptions(const SimulatorParameters& parameters, const std::string& where);

}  // namespace urban_nav_sim
