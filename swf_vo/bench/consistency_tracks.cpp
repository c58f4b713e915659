// SPDX-License-Identifier: BSD-3-Clause
// Is the covariance honest? Normalised squared errors of the pose at steps 50, 100 and 200, and of T_{i,i+100} composed from the
// relative covariances, over simulated tracks that turn through 360 deg and stop. 99 % of means of 50 lie in 4.81...7.34.
//   swf_vo-bench-consistency_tracks [RUNS [OUT.json]]
#include <Eigen/Cholesky>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "../test/window/track_runner.hpp"
#include "urban_nav_core/geometry/compose.hpp"
#include "urban_nav_core/testing/bench_table.hpp"

namespace {

using namespace swf_vo;
using urban_nav_core::Pose;
using urban_nav_core::testing::cell;

double nees(const Pose& truth, const urban_nav_core::UncertainPose& estimate) {
  const urban_nav_core::Vector6d e = urban_nav_core::boxMinus(truth, estimate.pose);
  return e.dot(estimate.covariance.ldlt().solve(e));
}

struct Case {
  const char* name;
  int size;
  bool first;
  double outliers;
};

struct Means {
  double at[3] = {0.0, 0.0, 0.0};
  double step = 0.0, composed = 0.0, settled = 0.0;
};

Means measure(const Case& test, int runs) {
  Means means;
  for (int r = 0; r < runs; ++r) {
    urban_nav_core::testing::TrackOptions motion;
    motion.seed = static_cast<std::uint64_t>(300 + r);
    motion.frames = 201;
    motion.motion = urban_nav_core::testing::TrackMotion::Mixed;
    motion.features = 60;
    motion.outliers = test.outliers;
    const auto tracks = simulateTracks(motion);
    WindowOptions options;
    options.size = test.size;
    options.linearise_first = test.first;
    options.exact_undo = false;
    TrackRunner run(tracks, options);
    while (!run.done()) {
      run.step();
      for (int s = 0; s < 3; ++s)
        if (run.at() == static_cast<std::size_t>(50 << s)) means.at[s] += nees(run.truth(), run.window.newest()) / runs;
    }
    for (const SettledPose& pose : run.window.flush()) run.settled.push_back(pose);
    double sum = 0.0;
    for (std::size_t i = 1; i < run.settled.size(); ++i)
      sum += nees(tracks.frames[i - 1].T_world_camera.inverse() * tracks.frames[i].T_world_camera,
                  {run.settled[i].T_previous_camera, run.settled[i].relative_covariance});
    means.step += sum / static_cast<double>(run.settled.size() - 1) / runs;
    urban_nav_core::UncertainPose composed{Pose(), urban_nav_core::Matrix6d::Zero()};
    for (std::size_t i = 51; i <= 150; ++i)
      composed = urban_nav_core::compose(composed, urban_nav_core::UncertainPose{run.settled[i].T_previous_camera, run.settled[i].relative_covariance});
    means.composed += nees(tracks.frames[50].T_world_camera.inverse() * tracks.frames[150].T_world_camera, composed) / runs;
    means.settled += nees(tracks.frames[150].T_world_camera, run.settled[150].T_odom_camera) / runs;
  }
  return means;
}

}  // namespace

int main(int argc, char** argv) {
  const int runs = argc > 1 ? std::atoi(argv[1]) : 50;
  const std::string path = argc > 2 ? argv[2] : "swf_vo/bench/results/consistency_tracks.json";
  urban_nav_core::testing::BenchTable table({"case", "NEES at 50", "at 100", "at 200", "settled at 150", "one step, settled", "T(i,i+100) composed"}, argc, argv);
  for (const Case& test : {Case{"k = 10", 10, true, 0.0}, Case{"k = 10, 3 % outliers", 10, true, 0.03}, Case{"k = 1", 1, true, 0.0},
                           Case{"k = 10, latest linearisation", 10, false, 0.0}}) {
    const Means means = measure(test, runs);
    table.add({test.name, cell(means.at[0], 2), cell(means.at[1], 2), cell(means.at[2], 2), cell(means.settled, 2), cell(means.step, 2), cell(means.composed, 2)});
    std::fputs(table.text().c_str(), stdout);
  }
  table.note("Means over " + std::to_string(runs) + " runs of 201 frames that turn through 360 deg twice and stop twice; a consistent filter has 6, and 99 % of means of 50 lie in 4.81...7.34.");
  table.write(path);
}
