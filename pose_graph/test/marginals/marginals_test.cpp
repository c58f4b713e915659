// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/marginals.hpp"

#include <limits>

#include "linear/index.hpp"
#include "pose_graph/solution.hpp"
#include "solve/normal_equations.hpp"
#include "support/drawn.hpp"
#include "urban_nav_core/geometry/compose.hpp"
#include "urban_nav_core/geometry/covariance_frames.hpp"
#include "urban_nav_core/geometry/dense.hpp"
#include "urban_nav_core/testing/bands.hpp"
#include "urban_nav_core/trajectory/nees.hpp"

namespace pose_graph::test {
namespace {

using urban_nav_core::Matrix6d;
using urban_nav_core::PoseWithCovariance;

/// Returns the edge in the convention of stage outputs: covariance in the parent's axes.
PoseWithCovariance withCovariance(const Edge<3>& edge) {
  Matrix6d turn = Matrix6d::Zero();
  turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = edge.Z.R;
  return {toPose(edge.Z), turn * *urban_nav_core::invertPositiveDefinite(edge.information) * turn.transpose()};
}

/// Returns the covariance of all poses by a dense inverse, 0 for the first, in the axes of the map.
template <int D>
Eigen::MatrixXd denseCovariance(const Problem<D>& problem) {
  constexpr int kN = kTangentSize<D>;
  NormalEquations<D> equations(problem);
  equations.linearise(Objective::Geodesic, problem.poses, {});
  const auto n = static_cast<Eigen::Index>(problem.poses.size());
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(kN * n, kN * n);
  const auto pose = [&](std::size_t place) {
    return kN * static_cast<Eigen::Index>(equations.unknowns().pose[sz(equations.symbolic().node[place])]);
  };
  const BlockPattern& pattern = equations.pattern();
  for (std::size_t k = 0; k + 1 < pattern.first.size(); ++k) {
    H.block<kN, kN>(pose(k), pose(k)) = equations.H().diagonal[k];
    for (int e = pattern.first[k]; e < pattern.first[k + 1]; ++e) {
      const Eigen::Index row = pose(sz(pattern.row[sz(e)]));
      H.block<kN, kN>(row, pose(k)) = equations.H().lower[sz(e)];
      H.block<kN, kN>(pose(k), row) = equations.H().lower[sz(e)].transpose();
    }
  }
  Eigen::MatrixXd made = Eigen::MatrixXd::Zero(kN * n, kN * n);
  const auto inverse = urban_nav_core::invertPositiveDefinite(H.bottomRightCorner(kN * (n - 1), kN * (n - 1)));
  EXPECT_TRUE(inverse);
  if (inverse) made.bottomRightCorner(kN * (n - 1), kN * (n - 1)) = *inverse;
  return made;
}

/// Returns the covariance of d_ab from those of d_a and d_b, with the core's Jacobians; in the axes of a.
Matrix6d expectedBetween(const Problem<3>& problem, const Eigen::MatrixXd& covariance, int a, int b) {
  const auto between = urban_nav_core::between(toPose(problem.poses[sz(a)]), toPose(problem.poses[sz(b)]));
  Eigen::MatrixXd joint(12, 12), J(6, 12);
  const int at[2] = {6 * a, 6 * b};
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) joint.block<6, 6>(6 * i, 6 * j) = covariance.block<6, 6>(at[i], at[j]);
  J << between.J1, between.J2;
  return J * joint * J.transpose();
}

TEST(Marginals, EveryPairEqualsTheDenseInverse) {
  Dice dice(1);
  const Problem<3> problem = drawProblem<3>(dice, 14, 8, 0.1, 0.1);
  const Marginals<3> marginals(problem, problem.poses);
  const Eigen::MatrixXd dense = denseCovariance(problem);
  for (int a = 0; a < 14; ++a) {
    EXPECT_EQ(marginals.first(a), 0);
    for (int b = 0; b < 14; ++b) {
      const Marginal<3> one = marginals.between(a, b);
      EXPECT_EQ(one.knowledge, Knowledge::Full);
      const Matrix6d expected = expectedBetween(problem, dense, a, b);
      if (a == b) EXPECT_EQ(one.covariance.norm(), 0.0);
      else EXPECT_LT((one.covariance - expected).norm(), 1e-8 * expected.norm()) << a << " " << b;
    }
  }
}

/// Marginals with fixed poses are those without, conditioned on the fixed poses.
TEST(Marginals, OfFixedPosesAreConditional) {
  Dice dice(11);
  Problem<3> problem = drawProblem<3>(dice, 14, 8, 0.1, 0.1);
  const Eigen::MatrixXd P = denseCovariance(problem);
  Eigen::MatrixXd across(P.rows(), 12);
  across << P.middleCols<6>(6 * 4), P.middleCols<6>(6 * 9);
  Eigen::MatrixXd own(12, 12);
  own << across.middleRows<6>(6 * 4), across.middleRows<6>(6 * 9);
  const Eigen::MatrixXd conditional = P - across * *urban_nav_core::invertPositiveDefinite(own) * across.transpose();
  problem.fixed = {0, 4, 9};
  const Marginals<3> marginals(problem, problem.poses);
  EXPECT_LT(marginals.between(4, 9).covariance.norm(), 1e-12);
  for (int a = 0; a < 14; ++a)
    for (int b = 0; b < 14; ++b) {
      if (a == b || (problem.fixed.end() != std::find(problem.fixed.begin(), problem.fixed.end(), a) &&
                     problem.fixed.end() != std::find(problem.fixed.begin(), problem.fixed.end(), b)))
        continue;
      const Matrix6d expected = expectedBetween(problem, conditional, a, b);
      EXPECT_LT((marginals.between(a, b).covariance - expected).norm(), 1e-6 * expected.norm()) << a << " " << b;
    }
  problem.fixed = {4, 9};
  EXPECT_EQ(Marginals<3>(problem, problem.poses).first(0), 4);
}

TEST(Marginals, ThePlaneIsAPartOfSpace) {
  using urban_nav_core::testing::evenNoise;
  const auto graph = urban_nav_core::testing::planarGridGraph(6, 5, 1.0, 0.4, evenNoise(0.05, 0.02), 3);
  Problem<2> plane = simulatedProblem<2>(graph, graph.truth);
  Problem<3> space = simulatedProblem<3>(graph, graph.truth);
  for (Edge<3>& edge : space.edges) edge.information += Eigen::Matrix<double, 6, 1>(0, 0, 7, 7, 7, 0).asDiagonal();
  for (Rigid<3>& pose : space.poses) pose.t.z() = 0.0;
  const Marginals<2> flat(plane, plane.poses);
  const Marginals<3> full(space, space.poses);
  for (int b = 1; b < 30; b += 4) {
    const TangentMatrix<2> three = flat.between(3, b).covariance;
    const TangentMatrix<3> six = full.between(3, b).covariance;
    const int kept[3] = {0, 1, 5};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) EXPECT_NEAR(three(i, j), six(kept[i], kept[j]), 1e-9);
  }
}

/// Without closures, the covariance of each link is propagated explicitly.
TEST(Marginals, AChainIsItsPropagatedCovariance) {
  Dice dice(2);
  Problem<3> problem = drawProblem<3>(dice, 40, 0, 0.3, 0.4);
  problem.edges.resize(39);
  for (Edge<3>& edge : problem.edges) edge.information += Matrix6d::Identity();
  problem.poses = solve(problem, {}).poses;
  const Marginals<3> marginals(problem, problem.poses);
  PoseWithCovariance from_first{urban_nav_core::Pose(), Matrix6d::Zero()};
  for (int i = 1; i < 40; ++i) {
    const Edge<3>& edge = problem.edges[sz(i - 1)];
    const PoseWithCovariance step =
        edge.from < edge.to ? withCovariance(edge) : urban_nav_core::invert(withCovariance(edge));
    from_first = urban_nav_core::compose(from_first, step);
    const Matrix6d covariance = marginals.ofPose(i).covariance;
    EXPECT_LT((covariance - from_first.covariance).norm(), 1e-7 * from_first.covariance.norm()) << i;
  }
}

template <int D>
void expectIndependentOfTheMap() {
  Dice dice(3);
  const Problem<D> problem = drawProblem<D>(dice, 12, 6, 0.1, 0.1);
  const Rigid<D> T = drawRigid<D>(dice, 50.0, 2.0);
  std::vector<Rigid<D>> moved_as_one;
  for (const Rigid<D>& pose : problem.poses) moved_as_one.push_back(T * pose);
  const Marginals<D> here(problem, problem.poses), there(problem, moved_as_one);
  for (int i = 0; i < 12; ++i) {
    const TangentMatrix<D> a = here.ofPose(i).covariance, b = there.ofPose(i).covariance;
    EXPECT_LT((a - b).norm(), 1e-8 * (1.0 + a.norm()));
  }
}
TEST(Marginals, DoNotDependOnThePositionOfTheMap) {
  expectIndependentOfTheMap<2>();
  expectIndependentOfTheMap<3>();
}

template <int D>
void expectParts() {
  Dice dice(4);
  Problem<D> problem = drawProblem<D>(dice, 10, 4, 0.1, 0.1);
  const Marginals<D> alone(problem, problem.poses);
  for (int i = 0; i < 6; ++i) problem.poses.push_back(drawRigid<D>(dice, 5.0, 1.0));
  for (int i = 11; i < 15; ++i)
    problem.edges.push_back({i - 1, i, drawRigid<D>(dice, 1.0, 0.5), drawInformation<D>(dice)});
  problem.edges.push_back({3, 12, drawRigid<D>(dice, 1.0, 0.5), TangentMatrix<D>::Zero()});      // no information
  problem.edges.push_back({4, 13, drawRigid<D>(dice, 1.0, 0.5), TangentMatrix<D>::Identity()});  // rejected
  std::vector<double> weights(problem.edges.size(), 1.0);
  weights.back() = 0.0;
  const Marginals<D> marginals(problem, problem.poses, weights);
  EXPECT_EQ(marginals.first(9), 0);
  EXPECT_EQ(marginals.first(14), 10);
  EXPECT_EQ(marginals.first(15), 15);
  EXPECT_EQ(marginals.between(0, 14).knowledge, Knowledge::None);
  EXPECT_EQ(marginals.between(15, 9).knowledge, Knowledge::None);
  EXPECT_EQ(marginals.ofPose(14).knowledge, Knowledge::Full);
  EXPECT_EQ(marginals.ofPose(15).knowledge, Knowledge::Full);
  EXPECT_EQ(marginals.ofPose(15).covariance.norm(), 0.0);
  for (int i = 0; i < 10; ++i) EXPECT_LT((marginals.ofPose(i).covariance - alone.ofPose(i).covariance).norm(), 1e-9);
}
TEST(Marginals, UnconnectedPartsHaveNoRelativeInformation) {
  expectParts<2>();
  expectParts<3>();
}

TEST(Marginals, WeightsAreFactorsOfTheInformation) {
  Dice dice(5);
  Problem<2> problem = drawProblem<2>(dice, 10, 5, 0.1, 0.1);
  const std::vector<double> weights(problem.edges.size(), 4.0);
  const Marginals<2> once(problem, problem.poses), four_times(problem, problem.poses, weights);
  const TangentMatrix<2> covariance = once.between(2, 8).covariance;
  EXPECT_LT((4.0 * four_times.between(2, 8).covariance - covariance).norm(), 1e-9 * covariance.norm());
}

/// A pose attached by an edge of deficient rank: constrained directions are known, the information is zero along free
/// ones, and all other marginals are as without the pose.
template <int D>
void expectFreeMarginals() {
  constexpr int kN = kTangentSize<D>;
  for (int rank = 1; rank < kN; ++rank) {
    Dice dice(static_cast<std::uint64_t>(6 + rank));
    Problem<D> problem = drawProblem<D>(dice, 12, 6, 0.05, 0.05);
    const Marginals<D> without(problem, problem.poses);
    Edge<D> loose{5, 12, drawRigid<D>(dice, 1.0, 0.5), drawInformation<D>(dice, rank)};
    problem.poses.push_back(problem.poses[5] * loose.Z);
    problem.edges.push_back(loose);
    const Marginals<D> marginals(problem, problem.poses);
    for (int i = 0; i < 12; ++i) {
      const Marginal<D> one = marginals.ofPose(i);
      EXPECT_EQ(one.knowledge, Knowledge::Full);
      const TangentMatrix<D> expected = without.ofPose(i).covariance;
      EXPECT_LT((one.covariance - expected).norm(), 1e-6 * expected.norm() + 1e-15) << "rank " << rank;
    }
    // Relative to its neighbour the edge is the only information.
    const Marginal<D> hanging = marginals.between(5, 12);
    ASSERT_EQ(hanging.knowledge, Knowledge::Partial) << "rank " << rank;
    TangentMatrix<D> turn = TangentMatrix<D>::Identity();
    turn.template topLeftCorner<D, D>() = loose.Z.R;
    if constexpr (D == 3) turn.template bottomRightCorner<3, 3>() = loose.Z.R;
    const TangentMatrix<D> turned_information = turn * loose.information * turn.transpose();
    EXPECT_LT((hanging.information - turned_information).norm(), 1e-5 * turned_information.norm()) << "rank " << rank;
    EXPECT_EQ(marginals.ofPose(12).knowledge, Knowledge::Partial);
  }
}
TEST(Marginals, FreeDirectionsHaveZeroInformation) {
  expectFreeMarginals<2>();
  expectFreeMarginals<3>();
}

/// Many links that leave the heading free, followed by more of the graph.
TEST(Marginals, FreeHeadingIsHandedOn) {
  Dice dice(7);
  Problem<2> problem = drawProblem<2>(dice, 20, 0, 0.0, 0.0);
  problem.edges.resize(19);
  for (Edge<2>& edge : problem.edges) edge.information.setIdentity();
  problem.edges[9].information(2, 2) = 0.0;
  const Marginals<2> marginals(problem, problem.poses);
  EXPECT_EQ(marginals.ofPose(9).knowledge, Knowledge::Full);
  for (int i = 10; i < 20; ++i) {
    const Marginal<2> one = marginals.ofPose(i);
    ASSERT_EQ(one.knowledge, Knowledge::Partial) << i;
    EXPECT_EQ(urban_nav_core::symmetricEigenvalues(one.information)->size(), 3);
    // The remaining part rotates about pose 10: this is the only free direction.
    Tangent<2> free;
    free << turned(Eigen::Vector2d(problem.poses[sz(i)].t - problem.poses[10].t)), 1.0;
    free.head<2>() = problem.poses[0].R.transpose() * free.head<2>();
    EXPECT_LT((one.information * free).norm(), 1e-6 * one.information.norm() * free.norm());
    EXPECT_GT((*urban_nav_core::symmetricEigenvalues(one.information))[1], 1e-4);
    EXPECT_EQ(marginals.between(10, i).knowledge, Knowledge::Full);
  }
}

TEST(Marginals, AreDisplayedWithTheLargestVarianceWhereNothingIsKnown) {
  Marginal<3> none;
  const Matrix6d shown = displayed(none, 1.0);
  EXPECT_NEAR(shown(0, 0), 1e6, 1.0);
  EXPECT_NEAR(shown(5, 5), 10.0, 1e-6);
  Marginal<3> full;
  full.knowledge = Knowledge::Full;
  full.covariance.setIdentity();
  EXPECT_EQ(displayed(full, 1.0), Matrix6d::Identity());
  Marginal<3> partial;
  partial.knowledge = Knowledge::Partial;
  partial.information.diagonal() << 4.0, 4.0, 4.0, 100.0, 100.0, 0.0;
  const Matrix6d mixed = displayed(partial, 1.0);
  EXPECT_NEAR(mixed(0, 0), 0.25, 1e-9);
  EXPECT_NEAR(mixed(3, 3), 0.01, 1e-9);
  EXPECT_NEAR(mixed(5, 5), 10.0, 1e-6);
}

TEST(Marginals, OverflowIsReportedAsNoKnowledge) {
  Dice dice(8);
  Problem<3> problem = drawProblem<3>(dice, 6, 3, 0.1, 0.1);
  problem.edges[2].information *= 1e308;
  const Marginals<3> marginals(problem, problem.poses);
  for (int i = 0; i < 6; ++i) {
    const Marginal<3> one = marginals.ofPose(i);
    EXPECT_TRUE(one.covariance.allFinite() && one.information.allFinite());
    EXPECT_TRUE(displayed(one, 1.0).allFinite());
  }
}

/// Simulated graphs with true information: errors match the stated covariances.
TEST(Marginals, NeesIsRight) {
  using namespace urban_nav_core::testing;
  double sum = 0.0;
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const GraphNoise noise = evenNoise(0.02, 0.01);
    const SimulatedGraph graph =
        seed % 2 == 0 ? sphereGraph(8, 14, 10.0, noise, seed) : gridGraph(5, 5, 4, 1.0, 0.2, noise, seed);
    const Problem<3> problem = simulatedProblem<3>(graph, deadReckoning(graph));
    const std::vector<Rigid<3>> poses = solve(problem, {}).poses;
    const Marginals<3> marginals(problem, poses);
    const int last = static_cast<int>(poses.size()) - 1;
    for (const int pose : {last / 2, last}) {
      const urban_nav_core::Pose estimate = toPose(poses[0].inverse() * poses[sz(pose)]);
      const auto one =
          urban_nav_core::nees(trueRelative(graph, 0, sz(pose)), {estimate, marginals.ofPose(pose).covariance});
      ASSERT_TRUE(one);
      sum += *one;
      ++count;
    }
  }
  // The two poses of a graph are correlated, so the interval is that of one.
  EXPECT_TRUE(meanChiSquareFits(sum / count, 6, 8, 0.999));
}

}  // namespace
}  // namespace pose_graph::test
