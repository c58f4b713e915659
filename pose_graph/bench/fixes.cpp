// SPDX-License-Identifier: BSD-3-Clause
// Effect of satellite position fixes on odometry: drives of 3 km that revisit no place, with one fix per second,
// time-correlated errors, and multipath lasting a minute.
//   pose_graph-bench-fixes [--seeds N] [-o results/fixes.json]
#include <algorithm>
#include <string>
#include <vector>

#include "../test/support/gps_drive.hpp"
#include "support/program.hpp"
#include "urban_nav_core/testing/bench_table.hpp"

namespace {

using namespace pose_graph;
using namespace pose_graph::bench;
using pose_graph::testing::GpsDrive;
using urban_nav_core::testing::cell;

constexpr double kSeconds = 2400.0;

/// A receiver and an odometry; the drives differ in their seeds.
struct Kind {
  std::string name;
  GpsDrive drive;
};

GpsDrive withErrors(double turn_drift, double slow, double white, double reflected, double stated) {
  GpsDrive drive;
  drive.turn_drift = turn_drift;
  drive.scale_error = 0.002;
  drive.slow = slow;
  drive.white = white;
  drive.reflected = reflected;
  drive.stated = stated;
  return drive;
}

std::vector<Kind> kinds() {
  return {{"heading drift of 0.17 deg per root of a metre", withErrors(0.003, 1.5, 0.5, 0.0, 2.0)},
          {"as above, multipath of 40 m for one minute in eight", withErrors(0.003, 1.5, 0.5, 40.0, 2.0)},
          {"as above, multipath of 8 m", withErrors(0.003, 1.5, 0.5, 8.0, 2.0)},
          {"as above, the receiver states 0.5 m", withErrors(0.003, 1.5, 0.5, 8.0, 0.5)},
          {"heading drift of 0.03 deg per root of a metre", withErrors(0.0005, 1.5, 0.5, 0.0, 2.0)},
          {"as above, fixes off by 8 m for a minute", withErrors(0.0005, 8.0, 1.0, 0.0, 8.0)}};
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

}  // namespace

int main(int argc, char** argv) try {
  const Arguments asked = parseArguments(argc, argv, {"--seeds"});
  const int seeds = asked.number("--seeds", 9);
  urban_nav_core::testing::BenchTable table({"odometry and receiver", "odometry only, m", "largest", "with fixes, m",
                                             "largest", "rejected, %", "sigma factor", "s"},
                                            argc, argv);
  for (const Kind& kind : kinds()) {
    std::vector<double> without, with, rejected, factors, seconds;
    for (int seed = 1; seed <= seeds; ++seed) {
      GpsDrive drive = kind.drive;
      testing::makeDrive(static_cast<unsigned>(seed), kSeconds, drive);
      without.push_back(positionError(drive, relaxDrive(drive, false).tracks()[0]));
      PoseGraph graph{Parameters()};
      seconds.push_back(measureSeconds(1, [&] { graph = relaxDrive(drive, true); }));
      with.push_back(positionError(drive, graph.tracks()[0]));
      rejected.push_back(100.0 * static_cast<double>(graph.fixUse().rejected) /
                         static_cast<double>(drive.fixes.size()));
      factors.push_back(graph.fixUse().sigma_factor);
    }
    table.add({kind.name, cell(median(without), 1), cell(*std::max_element(without.begin(), without.end()), 1),
               cell(median(with), 1), cell(*std::max_element(with.begin(), with.end()), 1), cell(median(rejected), 1),
               cell(median(factors), 2), cell(median(seconds), 2)});
  }
  table.note("Root mean square of positions after the best rigid alignment; medians and largest of " +
             std::to_string(seeds) +
             " drives of 3 km, two poses and a fix a second. Scale of odometry off by 0.2 %. "
             "Errors of fixes: 1.5 m unless stated, with a correlation time of 60 s, and 0.5 m of noise.");
  return show(table, asked.output);
} catch (const std::exception& error) {
  return complain(error);
}
