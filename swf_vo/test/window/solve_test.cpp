// SPDX-License-Identifier: BSD-3-Clause
#include "window/solve.hpp"

#include <gtest/gtest.h>

#include "window/filter.hpp"
#include "window/track_runner.hpp"

namespace swf_vo {
namespace {

// A window in operation, with landmarks inside and outside its prior, its gradients and its matrices.
struct System {
  State state;
  Prior prior;
  NormalEquations equations;
  std::vector<double> gradient;
  double offset_gradient = 0.0;
};

System systemAfter(int frames, int size, int features, bool absolute = true) {
  urban_nav_core::testing::TrackOptions motion;
  motion.seed = 21;
  motion.frames = frames;
  motion.features = features;
  motion.track_length = 8.0;
  const auto tracks = simulateTracks(motion);
  WindowOptions options;
  options.size = size;
  TrackRunner run(tracks, options);
  if (!absolute) run.first_information.setZero();
  while (!run.done()) run.step();
  System system{run.window.filter().state(), run.window.filter().prior(), {}, {}, 0.0};
  // Displaced from the optimum, so that the step is not zero.
  for (PoseBlock& pose : system.state.poses)
    pose.estimate = urban_nav_core::boxPlus(pose.estimate, urban_nav_core::Vector6d::Constant(0.002));
  run.window.filter().cost().relinearise(system.state, system.prior);
  run.window.filter().cost().build(system.state, system.equations);
  std::vector<double> d;
  system.prior.deviation(system.state, d);
  system.prior.gradient(d, system.state.disparity_offset, system.gradient, system.offset_gradient);
  return system;
}

void expectSame(const System& system, bool datum) {
  Solver path(Solver::Elimination::LandmarksFirst), map(Solver::Elimination::PosesFirst);
  for (Solver* solver : {&path, &map}) {
    solver->factor(system.state, system.prior, system.equations, datum);
    solver->solve(system.state, system.prior, system.equations, system.gradient, system.offset_gradient);
  }
  ASSERT_FALSE(path.eliminatedPosesFirst());
  ASSERT_TRUE(map.eliminatedPosesFirst());
  for (std::size_t j = 0; j < system.state.poses.size(); ++j)
    EXPECT_LT((path.poseStep(j) - map.poseStep(j)).norm(), 1e-9) << j;
  double largest = 0.0;
  for (std::size_t slot = 0; slot < system.state.landmarks.size(); ++slot) {
    if (!system.state.landmarks[slot].used) continue;
    EXPECT_LT((path.landmarkStep(slot) - map.landmarkStep(slot)).norm(), 1e-9) << slot;
    largest = std::max(largest, path.landmarkStep(slot).norm());
  }
  EXPECT_GT(largest, 1e-6) << "there is a step";
  EXPECT_NEAR(path.decrement(), map.decrement(), 1e-7 * path.decrement());
  for (const std::size_t j : {std::size_t{0}, system.state.poses.size() - 1})
    for (int c = 0; c < 6; ++c) {
      const std::vector<double> a = path.inverseColumn(j, c, false), b = map.inverseColumn(j, c, false);
      ASSERT_EQ(a.size(), b.size());
      double scale = 0.0, off = 0.0;
      for (std::size_t i = 0; i < a.size(); ++i) {
        scale = std::max(scale, std::abs(a[i]));
        off = std::max(off, std::abs(a[i] - b[i]));
      }
      EXPECT_LT(off, 1e-8 * scale) << j << ' ' << c;
      for (const Solver* solver : {&path, &map}) {
        const std::vector<double>& six = solver->inverseColumns(j);
        ASSERT_EQ(six.size(), 6 * a.size());
        for (std::size_t i = 0; i < a.size(); ++i)
          ASSERT_NEAR(six[static_cast<std::size_t>(c) * a.size() + i], a[i], 1e-8 * scale) << j << ' ' << c;
      }
    }
}

TEST(Solver, BothEliminationsGiveTheSame) { expectSame(systemAfter(30, 8, 20), false); }
TEST(Solver, BothEliminationsGiveTheSameWithoutAPriorMap) { expectSame(systemAfter(9, 12, 20), false); }
TEST(Solver, BothEliminationsGiveTheSameWithADatum) { expectSame(systemAfter(30, 8, 20, false), true); }

TEST(Solver, ChoosesTheCheaperElimination) {
  const System many_landmarks = systemAfter(30, 8, 40);
  Solver solver;
  solver.factor(many_landmarks.state, many_landmarks.prior, many_landmarks.equations, false);
  EXPECT_FALSE(solver.eliminatedPosesFirst());
  System few = systemAfter(90, 90, 6);
  // Only the first twenty landmarks.
  int left = 0;
  for (LandmarkBlock& landmark : few.state.landmarks)
    if (landmark.used && ++left > 20) landmark.seen.clear();
  Solver other;
  urban_nav_core::testing::TrackOptions any;
  any.frames = 1;
  Cost(SensorModel(simulateTracks(any).camera), 0.0, true).build(few.state, few.equations);
  other.factor(few.state, few.prior, few.equations, false);
  EXPECT_TRUE(other.eliminatedPosesFirst());
}

}  // namespace
}  // namespace swf_vo
