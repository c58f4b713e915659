// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "laser_odometry/parameters.hpp"
#include "urban_nav_core/parameters/sources.hpp"

namespace laser_odometry::bench {

/// Arguments of a bench: settings KEY=VALUE of the stage, and the file after -o.
struct BenchArguments {
  Parameters parameters;
  std::string output;  ///< empty: none
};

/// Reads the arguments from `first` on. Throws UserError.
inline BenchArguments readArguments(int argc, char** argv, int first) {
  BenchArguments arguments;
  std::vector<urban_nav_core::Assignment> settings;
  for (int i = first; i < argc; ++i) {
    if (std::string(argv[i]) == "-o" && i + 1 < argc) arguments.output = argv[++i];
    else settings.push_back(urban_nav_core::parseSetting("laser_odometry." + std::string(argv[i])));
  }
  arguments.parameters = load(table(), settings).parameters;
  return arguments;
}

}  // namespace laser_odometry::bench
