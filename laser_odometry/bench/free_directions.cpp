// SPDX-License-Identifier: BSD-3-Clause
// Errors and covariances in places that leave directions of the motion free, simulated with true poses.
//
//   laser_odometry-bench-free_directions [KEY=VALUE...] [-o FILE.json]
#include <cstdio>

#include "../test/support/free_places.hpp"
#include "arguments.hpp"
#include "urban_nav_core/testing/bench_table.hpp"
#include "urban_nav_core/types/error.hpp"

using urban_nav_core::testing::cell;

int main(int argc, char** argv) try {
  const auto [parameters, output] = laser_odometry::bench::readArguments(argc, argv, 1);
  urban_nav_core::testing::BenchTable table({"place", "seed", "sweeps", "free", "length, m", "error at the end, m",
                                             "stated, m", "NEES 1", "NEES 10", "NEES 50"},
                                            argc, argv);
  for (const laser_odometry::FreePlace& place : laser_odometry::makeFreePlaces())
    for (const std::uint64_t seed : {1, 2}) {
      const laser_odometry::FreeRun run = laser_odometry::driveFreePlace(place, parameters, seed);
      table.add({place.name, std::to_string(seed), std::to_string(run.poses.size()), std::to_string(run.free()),
                 cell(run.length(), 1), cell(run.error(run.poses.size() - 1), 3), cell(run.stated(), 3),
                 cell(run.nees(1), 1), cell(run.nees(10), 1), cell(run.nees(50), 1)});
    }
  std::fputs(table.text().c_str(), stdout);
  if (!output.empty()) table.write(output);
  return 0;
} catch (const urban_nav_core::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
