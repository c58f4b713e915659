// SPDX-License-Identifier: BSD-3-Clause
#include "gravity/level_odometry.hpp"

#include <gtest/gtest.h>

#include "../support/specific_force_drive.hpp"
#include "pose_graph/graph_file.hpp"

namespace pose_graph {
namespace {

using Eigen::Vector3d;
using testing::Drive;
using urban_nav_core::expSo3;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::testing::Dice;

/// Consecutive tracks, each a drive with rotation drift; a track may be broken.
struct TiltedChains {
  Problem<3> problem;
  std::vector<std::vector<StampNs>> stamps;
  std::vector<std::vector<SpecificForce>> forces;

  void add(const Drive& drive, Dice& dice, std::size_t broken_at = 0) {
    const auto truth = drive.trajectory();
    Rigid<3> pose;
    stamps.emplace_back();
    forces.push_back(drive.forces(dice));
    for (std::size_t i = 0; i < truth.size(); ++i) {
      stamps.back().push_back(truth[i].stamp);
      if (i > 0 && i != broken_at) {
        const Pose step = truth[i - 1].pose.inverse() * truth[i].pose;
        Edge<3> edge;
        edge.from = static_cast<int>(problem.poses.size()) - 1;
        edge.to = edge.from + 1;
        edge.Z = toRigid<3>(Pose(step.q() * expSo3(2e-4 * dice.normals<3>()), step.t()));
        edge.information *= 1.0 / 4e-8;
        problem.edges.push_back(edge);
        pose = pose * edge.Z;
      }
      problem.poses.push_back(pose);
    }
  }
};

double tiltBetween(const Rigid<3>& a, const Rigid<3>& b, const Vector3d& up) {
  return (a.R.transpose() * up - b.R.transpose() * up).norm();
}

TEST(LevelOdometry, TurnsStepsAndIntegratesThem) {
  Dice dice(1);
  Drive drive;
  drive.frames = 4000;
  drive.noise = 0.01;
  TiltedChains chains;
  chains.add(drive, dice);
  const Problem<3> before = chains.problem;
  const double lean = levelOdometry(chains.problem, before.edges.size(), chains.stamps, chains.forces);
  const auto truth = drive.trajectory();
  double lost_before = 0.0, lost_after = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const Rigid<3> right = toRigid<3>(truth[i].pose);
    lost_before = std::max(lost_before, tiltBetween(before.poses[i], right, drive.trueUp()));
    lost_after = std::max(lost_after, tiltBetween(chains.problem.poses[i], right, drive.trueUp()));
    if (i == 0) continue;
    const Edge<3>&step = chains.problem.edges[i - 1], &was = before.edges[i - 1];
    EXPECT_EQ(step.Z.t, was.Z.t);
    EXPECT_EQ(step.information, was.information);
    const Rigid<3> laid = chains.problem.poses[i - 1] * step.Z;
    EXPECT_LT((laid.R - chains.problem.poses[i].R).norm() + (laid.t - chains.problem.poses[i].t).norm(), 1e-9);
  }
  EXPECT_GT(lost_before, 0.008);
  EXPECT_NEAR(lean, lost_before, 0.3 * lost_before);
  EXPECT_LT(lost_after, 0.3 * lost_before);
}

TEST(LevelOdometry, TakesTracksAndTheirPiecesEachForItself) {
  Dice dice(2);
  Drive drive;
  drive.frames = 1500;
  drive.noise = 0.01;
  TiltedChains chains;
  chains.add(drive, dice);
  chains.forces.back().clear();
  chains.add(drive, dice, 700);
  chains.add(drive, dice);
  const std::size_t steps = chains.problem.edges.size();
  Edge<3> closure;  // between consecutive poses, like a step
  closure.from = 0;
  closure.to = 1;
  chains.problem.edges.push_back(closure);
  const Problem<3> before = chains.problem;
  levelOdometry(chains.problem, steps, chains.stamps, chains.forces);
  const auto moved = [&](std::size_t pose) {
    return (chains.problem.poses[pose].R - before.poses[pose].R).norm() > 1e-6;
  };
  EXPECT_FALSE(moved(1499)) << "no force was measured";
  EXPECT_FALSE(moved(1500));
  EXPECT_TRUE(moved(1500 + 699));
  EXPECT_FALSE(moved(1500 + 700)) << "a piece begins where it began";
  EXPECT_TRUE(moved(1500 + 1499));
  EXPECT_FALSE(moved(3000));
  EXPECT_TRUE(moved(3000 + 1499));
  EXPECT_EQ(chains.problem.edges.back().Z.R, closure.Z.R);
}

}  // namespace
}  // namespace pose_graph
