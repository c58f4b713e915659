// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "urban_nav_sim/session.hpp"

namespace urban_nav {

class Console;

struct SimulateJob {
  urban_nav_sim::SessionOptions session;
  std::string bag, folder;                             ///< folder: empty for none
  double part = 0.0;                                   ///< s of the session in a bag; 0: one bag for all
  double false_closures = 0.0;                         ///< per cent of the true ones
  std::vector<std::string> lags = {}, misplaced = {};  ///< for parseCalibrationErrors()
};

struct Simulated {
  std::vector<std::string> bags;
  std::string truth_folder;
  double distance_m = 0.0;
  std::map<std::string, std::int64_t> counts;  ///< messages by topic
};

/// Writes the truth, the folder and finally the bag, or its last part, whose existence implies complete output. Throws
/// UserError. An interrupt leaves no incomplete bag.
Simulated simulate(const SimulateJob& job, Console& console);

}  // namespace urban_nav
