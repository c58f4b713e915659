// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/pose_graph.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "pose_graph/graph_file.hpp"
#include "pose_graph_ceres/solve_by_ceres.hpp"
#include "pose_graph_relative/relative_pcg.hpp"
#include "urban_nav_core/testing/numeric_jacobian.hpp"
#include "urban_nav_core/types/error.hpp"

namespace pose_graph {
namespace {

using Eigen::Vector3d;
using urban_nav_core::expSo3;
using urban_nav_core::Matrix6d;
using urban_nav_core::RelativePose;
using urban_nav_core::UserError;
using urban_nav_core::Vector6d;

constexpr StampNs kNodeStep = 50'000'000;
constexpr int kRound = 400;  // steps of a square of 20 m

// A square with steps of 5 cm and a quarter turn at each corner.
Pose truthAt(int i) {
  Pose T;
  for (int k = 0; k < i; ++k)
    T = T * Pose(expSo3(Vector3d(0.0, 0.0, (k + 1) % (kRound / 4) == 0 ? M_PI_2 : 0.0)), Vector3d(0.05, 0.0, 0.0));
  return T;
}

RelativePose stepAt(int i, double turn_error) {
  RelativePose step;
  step.from = i * kNodeStep;
  step.to = (i + 1) * kNodeStep;
  step.T_from_to =
      truthAt(i).inverse() * truthAt(i + 1) * Pose(expSo3(Vector3d(0.0, 0.0, turn_error)), Vector3d::Zero());
  Vector6d sigma;
  sigma << 1e-3, 1e-3, 1e-3, 5e-4, 5e-4,
      1e-2;  // an accumulating rotation error per step is within odometry's covariance
  step.covariance = sigma.cwiseAbs2().asDiagonal();
  step.drift_covariance = 0.5 * step.covariance;
  return step;
}

void driveRounds(PoseGraph& graph, const SessionId& session, int first, int last, double turn_error) {
  for (int i = first; i < last; ++i) ASSERT_TRUE(graph.addOdometry(session, stepAt(i, turn_error)));
}

Closure closureBetween(const SessionId& session_a, int a, const SessionId& session_b, int b) {
  Closure closure;
  closure.a = {session_a, a * kNodeStep};
  closure.b = {session_b, b * kNodeStep};
  closure.kind = EdgeKind::Icp;
  closure.source = "test";
  closure.measured.T_a_b = truthAt(a).inverse() * truthAt(b);
  Vector6d weight;
  weight << 1e4, 1e4, 1e4, 1e5, 1e5, 1e5;
  closure.measured.information = weight.asDiagonal();
  return closure;
}

double worstError(const Track& track, int first) {
  double worst = 0.0;
  for (std::size_t i = 0; i < track.map.size(); ++i)
    worst = std::max(worst, distanceBetween(track.map[i], truthAt(first + static_cast<int>(i))));
  return worst;
}

TEST(PoseGraph, ClosesALoop) {
  PoseGraph graph{Parameters()};
  driveRounds(graph, "a", 0, 2 * kRound, 5e-4);
  const double before = worstError(graph.tracks()[0], 0);
  EXPECT_GT(before, 1.0);
  for (int i = 20; i < kRound; i += 40) graph.addClosure(closureBetween("a", i, "a", i + kRound));
  const Relaxed relaxed = graph.relax();
  EXPECT_EQ(relaxed.accepted, 10u);
  EXPECT_EQ(relaxed.parts, 1);
  EXPECT_EQ(relaxed.revision, 1);
  EXPECT_LT(relaxed.cost_after, relaxed.cost_before);
  EXPECT_LT(worstError(graph.tracks()[0], 0), 0.7 * before);
  ASSERT_TRUE(relaxed.correction);
  EXPECT_EQ(relaxed.correction->reason, CorrectionReason::ClosuresAccepted);
  EXPECT_EQ(relaxed.correction->causing_edges.size(), 10u);
  ASSERT_FALSE(relaxed.moved.empty());
}

TEST(PoseGraph, ReportsTheReasonOfACorrection) {
  PoseGraph graph{Parameters()};
  driveRounds(graph, "a", 0, 2 * kRound, 5e-4);
  const ClosureId first = graph.addClosure(closureBetween("a", 20, "a", 20 + kRound));
  const ClosureId second = graph.addClosure(closureBetween("a", 300, "a", 300 + kRound));
  graph.relax();
  graph.removeClosure(first);
  EXPECT_TRUE(graph.removeClosure(second));
  const Relaxed without = graph.relax();
  ASSERT_TRUE(without.correction);
  EXPECT_EQ(without.correction->reason, CorrectionReason::ClosuresRemoved);
  ASSERT_EQ(without.correction->causing_edges.size(), 2u);
  EXPECT_EQ(without.correction->causing_edges[1].a.stamp, 300 * kNodeStep);

  Closure asserted = closureBetween("a", 20, "a", 20 + kRound);
  asserted.kind = EdgeKind::Asserted;
  graph.addClosure(asserted);
  const Relaxed by_hand = graph.relax();
  ASSERT_TRUE(by_hand.correction);
  EXPECT_EQ(by_hand.correction->reason, CorrectionReason::ClosureAsserted);
  EXPECT_EQ(by_hand.correction->causing_edges.size(), 1u);

  // Corrections are reported only for the active session, and only if its newest pose moves.
  EXPECT_FALSE(graph.relax().correction);
  graph.beginSession("b");
  graph.removeClosure(*graph.findClosure(asserted.a, asserted.b, EdgeKind::Asserted, asserted.source));
  EXPECT_FALSE(graph.relax().correction);
}

TEST(PoseGraph, ReferenceSolversReachTheSameCost) {
  const auto costBy = [](const std::string& solver, const ReferenceSolvers& references) {
    Parameters parameters;
    parameters.solver = solver;
    PoseGraph graph{parameters};
    driveRounds(graph, "a", 0, 2 * kRound, 2e-4);
    for (int i = 20; i < kRound; i += 40) graph.addClosure(closureBetween("a", i, "a", i + kRound));
    return graph.relax({}, references).cost_after;
  };
  const double cost = costBy("gauss_newton", {});
  for (const ReferenceSolver& reference : {relativeSolver(), ceresSolver()}) {
    const double by_reference = costBy(reference.name, {reference});
    EXPECT_NEAR(by_reference, cost, 1e-4 * cost) << reference.name;
    EXPECT_NE(by_reference, cost) << reference.name << " must not be the default solver";
  }
}

TEST(PoseGraph, NamesTheSolversThatItHas) {
  const auto allowed = [](const ReferenceSolvers& references) -> std::string {
    Parameters parameters;
    parameters.solver = "ceres";
    PoseGraph graph{parameters};
    try {
      graph.relax({}, references);
    } catch (const UserError& error) {
      EXPECT_EQ(error.parts().found, "pose_graph.solver = ceres");
      return error.parts().allowed;
    }
    return "";
  };
  EXPECT_EQ(allowed({relativeSolver()}), "gauss_newton, relative_pcg");
  EXPECT_EQ(allowed({}), "gauss_newton; reference solvers are for the commands relax and map");
  EXPECT_EQ(allowed({ceresSolver()}), "");
}

TEST(PoseGraph, LeavesNoTraceOfEarlierRelaxations) {
  PoseGraph once{Parameters()}, often{Parameters()};
  for (PoseGraph* graph : {&once, &often}) driveRounds(*graph, "a", 0, 2 * kRound, 2e-4);
  for (int i = 20; i < kRound; i += 40) {
    once.addClosure(closureBetween("a", i, "a", i + kRound));
    often.addClosure(closureBetween("a", i, "a", i + kRound));
    often.relax();
  }
  once.relax();
  for (std::size_t i = 0; i < once.tracks()[0].map.size(); ++i) {
    EXPECT_EQ(once.tracks()[0].map[i].t(), often.tracks()[0].map[i].t());
    EXPECT_EQ(once.tracks()[0].map[i].q().coeffs(), often.tracks()[0].map[i].q().coeffs());
  }
}

TEST(PoseGraph, TakesAddedClosuresAsTheBatchDoes) {
  PoseGraph live{Parameters()}, batch{Parameters()};
  for (PoseGraph* graph : {&live, &batch}) driveRounds(*graph, "a", 0, 2 * kRound, 2e-4);
  for (int i = 20; i < kRound; i += 40) {
    for (PoseGraph* graph : {&live, &batch}) graph->addClosure(closureBetween("a", i, "a", i + kRound));
    if (i == 60) live.relax();
    if (i > 60) {
      const Relaxed added = live.update();
      EXPECT_EQ(added.rejected, 0u);
      EXPECT_TRUE(added.needs_batch) << "no set of closures was weighed";
    }
  }
  batch.relax();
  for (std::size_t i = 0; i < live.tracks()[0].map.size(); i += 50)
    EXPECT_TRUE(isApprox(live.tracks()[0].map[i], batch.tracks()[0].map[i], 1e-2)) << i;

  // A closure with an error of 3 m is rejected and requests a batch.
  Closure wrong = closureBetween("a", 130, "a", 130 + kRound);
  wrong.measured.T_a_b = Pose(wrong.measured.T_a_b.q(), wrong.measured.T_a_b.t() + Vector3d(3.0, 0.0, 0.0));
  const ClosureId id = live.addClosure(wrong);
  const Pose before = live.tracks()[0].map.back();
  EXPECT_TRUE(live.update().needs_batch);
  EXPECT_EQ(live.closures().at(id).verdict, ClosureVerdict::Rejected);
  EXPECT_GT(live.closures().at(id).chi2, 22.0);
  EXPECT_TRUE(isApprox(live.tracks()[0].map.back(), before, 1e-2));
}

TEST(PoseGraph, WaitsForConfirmationOfALargeCorrection) {
  PoseGraph graph{Parameters()};
  driveRounds(graph, "a", 0, 2 * kRound, 3e-4);
  const ClosureId first = graph.addClosure(closureBetween("a", 100, "a", 100 + kRound));
  EXPECT_EQ(graph.relax().waiting, 1u);
  EXPECT_EQ(graph.closures().at(first).verdict, ClosureVerdict::Waiting);
  EXPECT_EQ(graph.status().reason, static_cast<int>(Trouble::Waiting));
  EXPECT_TRUE(isApprox(graph.tracks()[0].map.back(), graph.tracks()[0].odom.back(), 1e-9));
  graph.addClosure(closureBetween("a", 140, "a", 140 + kRound));
  EXPECT_EQ(graph.relax().accepted, 2u);

  PoseGraph trusting{Parameters()};
  driveRounds(trusting, "a", 0, 2 * kRound, 3e-4);
  Closure sure = closureBetween("a", 100, "a", 100 + kRound);
  sure.kind = EdgeKind::Stereo;
  sure.odometry_gate = true;
  trusting.addClosure(sure);
  EXPECT_EQ(trusting.relax().accepted, 1u);
}

TEST(PoseGraph, FusesSessionsByTwoClosures) {
  PoseGraph graph{Parameters()};
  driveRounds(graph, "monday", 0, kRound, 0.0);
  driveRounds(graph, "tuesday", 100, 300, 0.0);  // begins elsewhere, in its own odom frame
  EXPECT_EQ(graph.relax().parts, 2);
  EXPECT_EQ(graph.status().reason, static_cast<int>(Trouble::Separate));
  graph.addClosure(closureBetween("monday", 120, "tuesday", 120));
  graph.addClosure(closureBetween("monday", 250, "tuesday", 250));
  const Relaxed relaxed = graph.relax();
  EXPECT_EQ(relaxed.parts, 1);
  EXPECT_EQ(relaxed.sessions_joined, 2);
  EXPECT_LT(worstError(graph.tracks()[1], 100), 1e-3);
  EXPECT_EQ(graph.tracks()[1].part.back(), 0);
}

TEST(PoseGraph, ReportsInvalidClosures) {
  PoseGraph graph{Parameters()};
  driveRounds(graph, "a", 0, 100, 0.0);
  const auto message = [&](Closure closure) {
    try {
      graph.addClosure(closure);
    } catch (const UserError& error) {
      return std::string(error.what());
    }
    return std::string("taken");
  };
  Closure closure = closureBetween("a", 10, "a", 60);
  closure.b.stamp += 1000;
  EXPECT_NE(message(closure).find("nearest is 3.000000000"), std::string::npos) << message(closure);
  closure = closureBetween("a", 10, "b", 60);
  EXPECT_NE(message(closure).find("session b"), std::string::npos);
  closure = closureBetween("a", 10, "a", 10);
  EXPECT_NE(message(closure).find("both ends are"), std::string::npos);
  closure = closureBetween("a", 10, "a", 60);
  closure.measured.information(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(message(closure).find("non-finite"), std::string::npos);
  closure.measured.information = -Matrix6d::Identity();
  EXPECT_NE(message(closure).find("negative eigenvalue"), std::string::npos);
  EXPECT_TRUE(graph.closures().empty());
}

TEST(PoseGraph, ReplacesAndRemovesClosures) {
  PoseGraph graph{Parameters()};
  driveRounds(graph, "a", 0, 100, 0.0);
  const ClosureId id = graph.addClosure(closureBetween("a", 10, "a", 60));
  EXPECT_EQ(graph.addClosure(closureBetween("a", 10, "a", 60)), id);
  EXPECT_EQ(graph.closures().size(), 1u);
  EXPECT_TRUE(graph.removeClosure(id));
  EXPECT_FALSE(graph.removeClosure(id));
}

TEST(PoseGraph, HandlesInvalidOdometry) {
  PoseGraph graph{Parameters()};
  driveRounds(graph, "a", 0, 50, 0.0);
  RelativePose step = stepAt(50, 0.0);
  step.covariance(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(graph.addOdometry("a", step));
  EXPECT_FALSE(graph.addOdometry("a", stepAt(20, 0.0)));  // earlier than the newest pose
  EXPECT_TRUE(graph.addOdometry("a", stepAt(55, 0.0)));   // after a gap
  EXPECT_EQ(graph.status().reason, static_cast<int>(Trouble::BrokenChain));
  EXPECT_EQ(graph.relax().parts, 2);
  for (const Pose& pose : graph.tracks()[0].map) EXPECT_TRUE(pose.isFinite());
}

TEST(ClosureInformation, AddsTheNoiseOfTheEndsAndLeavesFreeWhatIsFree) {
  urban_nav_core::Constraint measured;
  measured.T_a_b = Pose(expSo3(Vector3d(0.1, -0.2, 0.9)), Vector3d(3.0, -1.0, 0.5));
  Vector6d weight;
  weight << 1e4, 2e4, 3e4, 1e5, 2e5, 3e5;
  measured.information = weight.asDiagonal();
  const Matrix6d none = Matrix6d::Zero(), small = 1e-4 * Matrix6d::Identity();
  Matrix6d turned = Matrix6d::Zero();
  turned.topLeftCorner<3, 3>() = turned.bottomRightCorner<3, 3>() = measured.T_a_b.R();
  EXPECT_LT((closureInformation(measured, none, none) - turned.transpose() * measured.information * turned).norm(),
            1e-6);
  // Covariances add up: that of b is rotated, that of a is transformed by its lever arm.
  Matrix6d lever = Matrix6d::Identity();
  lever.topRightCorner<3, 3>() = -urban_nav_core::skew(measured.T_a_b.t());
  const Matrix6d sum = Matrix6d(measured.information.inverse() + small + lever * small * lever.transpose());
  const Matrix6d expected = turned.transpose() * sum.inverse() * turned;
  EXPECT_LT((closureInformation(measured, small, small) - expected).norm(), 1e-6 * expected.norm());
  measured.information(2, 2) = 0.0;
  const Matrix6d free = turned * closureInformation(measured, small, small) * turned.transpose();
  EXPECT_LT(free.col(2).norm(), 1e-6);
}

}  // namespace
}  // namespace pose_graph
