// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/graph_file.hpp"

#include <Eigen/Eigenvalues>

#include "pose_graph/solution.hpp"
#include "support/drawn.hpp"
#include "support/plain_costs.hpp"
#include "urban_nav_core/testing/fuzz.hpp"
#include "urban_nav_core/types/error.hpp"

namespace pose_graph::test {
namespace {

using urban_nav_core::G2oGraph;
using urban_nav_core::parseG2o;
using urban_nav_core::UserError;

const std::string kI2 = " 50 1 2 60 3 100\n";
const std::string kI3 = " 10 0 0 1 0 0  20 0 0 2 0  30 0 0 3  40 0 0  50 0  60\n";

const std::string kPlane =
    "VERTEX_SE2 40 1 2 0.5\n"
    "VERTEX_SE2 7 0 0 0\n"
    "EDGE_SE2 7 40 1 2 0.5" +
    kI2 + "EDGE_SE2 40 1000000000000 1 0 0" + kI2;
const std::string kSpace =
    "VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1\n"
    "VERTEX_SE3:QUAT 1 1 0 0 0 0 0.6 0.8\n"
    "EDGE_SE3:QUAT 0 1 1 0.5 0 0 0 0.6 0.8" +
    kI3;

template <int D>
FileProblem<D> parsed(const std::string& text) {
  return makeProblem<D>(parseG2o(text, "g.g2o"), "g.g2o");
}

std::string catchError(const std::string& text) {
  try {
    const G2oGraph graph = parseG2o(text, "g.g2o");
    if (graph.dimension == 2) makeProblem<2>(graph, "g.g2o");
    else makeProblem<3>(graph, "g.g2o");
  } catch (const UserError& error) {
    return error.what();
  }
  return "";
}

TEST(GraphFile, IdsWithGapsBecomeNumbersInTheirOrder) {
  const FileProblem<2> file = parsed<2>(kPlane);
  EXPECT_EQ(file.ids, (std::vector<G2oGraph::Id>{7, 40, 1000000000000}));
  ASSERT_EQ(file.problem.edges.size(), 2U);
  EXPECT_EQ(file.problem.edges[0].from, 0);
  EXPECT_EQ(file.problem.edges[0].to, 1);
  EXPECT_EQ(file.problem.edges[1].from, 1);
  EXPECT_EQ(file.problem.edges[1].to, 2);
  EXPECT_EQ(file.problem.poses[1].t, Eigen::Vector2d(1, 2));
  TangentMatrix<2> information;
  information << 50, 1, 2, 1, 60, 3, 2, 3, 100;
  EXPECT_EQ(file.problem.edges[0].information, information);
}

TEST(GraphFile, VerticesThatAreNotListedFollowTheEdgesAndAreNamed) {
  const FileProblem<2> file = parsed<2>(kPlane);
  ASSERT_EQ(file.notes.size(), 1U);
  EXPECT_NE(file.notes[0].find("1 vertices"), std::string::npos) << file.notes[0];
  EXPECT_NE(file.notes[0].find("1000000000000"), std::string::npos) << file.notes[0];
  const Rigid<2> expected = file.problem.poses[1] * file.problem.edges[1].Z;
  EXPECT_LT((file.problem.poses[2].t - expected.t).norm(), 1e-12);

  const FileProblem<2> bare = parsed<2>("EDGE_SE2 3 5 1 0 0" + kI2 + "EDGE_SE2 5 6 1 0 0" + kI2);
  ASSERT_EQ(bare.notes.size(), 1U);
  EXPECT_EQ(bare.problem.poses[2].t, Eigen::Vector2d(2, 0));
}

/// The g2o cost of a problem equals that of the file's numbers.
TEST(GraphFile, InformationOfSpaceIsThatOfTheQuaternionsVector) {
  const FileProblem<3> file = parsed<3>(kSpace);
  const Edge<3>& edge = file.problem.edges[0];
  EXPECT_EQ(edge.information(0, 0), 10.0);
  EXPECT_EQ(edge.information(0, 3), 0.5);
  EXPECT_EQ(edge.information(5, 5), 15.0);
  const Eigen::Vector3d phi(0.3, -0.2, 0.5);
  const Rigid<3> to = file.problem.poses[0] * edge.Z * Rigid<3>{expRotation(phi), Eigen::Vector3d(0.1, 0.2, 0.3)};
  Eigen::Matrix<double, 6, 1> e;
  e << 0.1, 0.2, 0.3, std::sin(0.5 * phi.norm()) * phi.normalized();
  const Eigen::MatrixXd raw = urban_nav_core::g2oInformation(parseG2o(kSpace, "").edges[0], 3);
  EXPECT_NEAR(cost(file.problem, {file.problem.poses[0], to}, Objective::G2o), e.dot(raw * e), 1e-10);
}

TEST(GraphFile, IndefiniteInformationIsNamed) {
  const std::string plane = catchError("EDGE_SE2 3 5 1 0 0 1 2 0 1 0 1\n");
  EXPECT_NE(plane.find("g.g2o"), std::string::npos) << plane;
  EXPECT_NE(plane.find("from 3 to 5"), std::string::npos) << plane;
  EXPECT_NE(catchError("EDGE_SE2 3 5 1 0 0 -1e-3 0 0 0 0 0\n"), "");
  std::string space = kSpace;
  space.replace(space.rfind("60"), 2, "-60");
  EXPECT_NE(catchError(space).find("from 0 to 1"), std::string::npos);
}

TEST(GraphFile, SemidefiniteInformationPasses) {
  EXPECT_EQ(catchError("EDGE_SE2 3 5 1 0 0 4 0 0 4 0 0\n"), "");
  EXPECT_EQ(catchError("EDGE_SE2 3 5 1 0 0 0 0 0 0 0 0\n"), "");
  EXPECT_EQ(catchError("EDGE_SE2 3 5 1 0 0 1 3 0 9 0 0\n"), "");
}

TEST(GraphFile, WhatIsIndefiniteBetweenItsBlocksServesTheChordalObjective) {
  const auto blocks = [](const std::string& edge) {
    return makeProblem<2>(parseG2o("VERTEX_SE2 3 0 0 0\nVERTEX_SE2 5 1 0 0\n" + edge, "g.g2o"), "g.g2o",
                          Semidefinite::Blocks);
  };
  const std::string across = "EDGE_SE2 3 5 1 0 0 4 0 9 4 9 1\n", within = "EDGE_SE2 3 5 1 0 0 4 9 0 4 0 1\n";
  EXPECT_NE(catchError(across), "");
  const FileProblem<2> file = blocks(across);
  ASSERT_EQ(file.notes.size(), 1U);
  EXPECT_NE(file.notes[0].find("1 edges have information with a negative eigenvalue"), std::string::npos);
  EXPECT_THROW(blocks(within), UserError);
}

TEST(GraphFile, RankDeficientInformationOfSixDigitsIsMadeSemidefinite) {
  // (1, 2, 3) (1, 2, 3)^T / 7 printed with six digits.
  const std::string edge = "EDGE_SE2 0 1 1 0 0 0.142857 0.285714 0.428571 0.571429 0.857143 1.28571\n";
  const FileProblem<2> file = parsed<2>("VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 0\n" + edge);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(file.problem.edges[0].information);
  EXPECT_GT(eigen.eigenvalues()[0], -1e-12);
  EXPECT_NEAR(eigen.eigenvalues()[2], 2.0, 1e-5);
}

TEST(GraphFile, AnEdgeToItselfIsOmittedAndReported) {
  const FileProblem<2> file = parsed<2>("EDGE_SE2 0 0 1 0 0" + kI2 + "EDGE_SE2 0 -1 1 0 0" + kI2);
  EXPECT_EQ(file.ids, (std::vector<G2oGraph::Id>{-1, 0}));
  EXPECT_EQ(file.edges, (std::vector<int>{-1, 0}));
  ASSERT_EQ(file.problem.edges.size(), 1U);
  EXPECT_NE(file.notes[0].find("itself"), std::string::npos);
}

// A path with priors at both ends and a landmark observed from both.
const std::string kConstrained =
    "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 0.2\nVERTEX_SE2 2 2 0.3 0.4\nVERTEX_XY 7 3 3\n"
    "EDGE_SE2 0 1 1 0 0.2" +
    kI2 + "EDGE_SE2 1 2 1 0.1 0.1" + kI2 +
    "EDGE_SE2_XY 0 7 3 2.5 20 1 30\nEDGE_SE2_XY 2 7 1.6 2.2 10 0 15\n"
    "EDGE_PRIOR_SE2 0 100 50 1 8 0 0 8 0 9\nEDGE_PRIOR_SE2_XY 2 100.8 51.9 40 2 50\n";

/// Returns the cost of the file's lines as g2o defines them, at the poses of a graph.
double costOfLines(const G2oGraph& graph) {
  double sum = 0.0;
  const auto vertex = [&](G2oGraph::Id id) {
    for (const G2oGraph::Vertex& v : graph.vertices)
      if (v.id == id) return toRigid<2>(graph.pose(v));
    return Rigid<2>{};
  };
  const auto squared = [](const Rigid<2>& E, const Eigen::Matrix3d& information) {
    const Eigen::Vector3d e(E.t.x(), E.t.y(), std::atan2(E.R(1, 0), E.R(0, 0)));
    return e.dot(information * e);
  };
  for (const G2oGraph::Edge& edge : graph.edges)
    sum += squared(toRigid<2>(graph.pose(edge)).inverse() * vertex(edge.from).inverse() * vertex(edge.to),
                   urban_nav_core::g2oInformation(edge, 2));
  for (const G2oGraph::PointEdge& edge : graph.point_edges) {
    const Eigen::Vector2d landmark(graph.points[0].values[0], graph.points[0].values[1]);
    const Rigid<2> T = vertex(edge.from).inverse();
    const Eigen::Vector2d e = T.R * landmark + T.t - Eigen::Vector2d(edge.values[0], edge.values[1]);
    sum +=
        edge.information[0] * e[0] * e[0] + 2.0 * edge.information[1] * e[0] * e[1] + edge.information[2] * e[1] * e[1];
  }
  for (const G2oGraph::Prior& prior : graph.priors) {
    Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
    G2oGraph::Edge full;
    full.information = prior.information;
    if (!prior.position) information = urban_nav_core::g2oInformation(full, 2);
    else
      information.topLeftCorner<2, 2>() << prior.information[0], prior.information[1], prior.information[1],
          prior.information[2];
    Rigid<2> E = toRigid<2>(graph.pose(prior)).inverse() * vertex(prior.vertex);
    sum += squared(E, information);
  }
  return sum;
}

TEST(GraphFile, LandmarksAndPriorsHaveTheCostOfTheirLines) {
  const G2oGraph graph = parseG2o(kConstrained, "g.g2o");
  const FileProblem<2> file = parsed<2>(kConstrained);
  EXPECT_EQ(file.problem.poses.size(), 5U);
  SolveOptions options;
  const Solution<2> solution = solve(file.problem, options);
  const G2oGraph made = withPoses(graph, file, solution.poses);
  EXPECT_NEAR(costOfLines(made), solution.cost, 1e-9 * solution.cost);
  EXPECT_GT(solution.cost, 0.01);
  // No change of any number of the file lowers the cost.
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t axis = 0; axis < (i < 3 ? 3U : 2U); ++axis)
      for (const double step : {-1e-4, 1e-4}) {
        G2oGraph moved = made;
        (i < 3 ? moved.vertices[i].values[axis] : moved.points[0].values[axis]) += step;
        EXPECT_GT(costOfLines(moved), solution.cost) << i << " " << axis;
      }
  EXPECT_NEAR(made.vertices[0].values[0], 100.0, 1.0);
}

TEST(GraphFile, FixedVerticesKeepTheirNumbers) {
  const std::string text = kConstrained + "FIX 0 2\nFIX 99\n";
  const G2oGraph graph = parseG2o(text, "g.g2o");
  const FileProblem<2> file = parsed<2>(text);
  EXPECT_NE(file.notes.back().find("99"), std::string::npos);
  const Solution<2> solution = solve(file.problem, {});
  const G2oGraph made = withPoses(graph, file, solution.poses);
  EXPECT_EQ(made.vertices[0].values, graph.vertices[0].values);
  EXPECT_EQ(made.vertices[2].values, graph.vertices[2].values);
  const Rigid<2>&frame = solution.poses[static_cast<std::size_t>(file.frame)], &held = solution.poses[2];
  EXPECT_EQ((frame.inverse() * held).t, Eigen::Vector2d(2, 0.3));
  EXPECT_NEAR(costOfLines(made), solution.cost, 1e-9 * solution.cost);
  for (const double step : {-1e-3, 1e-3}) {
    G2oGraph moved = made;
    moved.vertices[1].values[0] += step;
    EXPECT_GT(costOfLines(moved), costOfLines(made));
  }
}

TEST(GraphFile, SensorsOfSpaceAreAtTheirMounts) {
  const std::string text =
      "PARAMS_SE3OFFSET 3 0.5 0 0.2 0 0 0.6 0.8\nPARAMS_SE3OFFSET 0 0 0 0 0 0 0 1\n"
      "VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1\nVERTEX_TRACKXYZ 5 9 9 9\n"
      "EDGE_SE3_TRACKXYZ 0 5 3 1 2 3 10 0 0 20 0 30\n"
      "EDGE_SE3_PRIOR 0 3 1 2 3 0 0 0 1" +
      kI3;
  const G2oGraph graph = parseG2o(text, "g.g2o");
  const FileProblem<3> file = makeProblem<3>(graph, "g.g2o");
  const G2oGraph made = withPoses(graph, file, solve(file.problem, {}).poses);
  const urban_nav_core::Pose sensor = made.pose(made.vertices[0]) * made.pose(made.offsets[0]);
  EXPECT_LT((sensor.t() - Eigen::Vector3d(1, 2, 3)).norm(), 1e-6);
  EXPECT_NEAR(std::abs(sensor.q().w()), 1.0, 1e-9);
  const Eigen::Vector3d landmark(made.points[0].values[0], made.points[0].values[1], made.points[0].values[2]);
  EXPECT_LT((landmark - Eigen::Vector3d(2, 4, 6)).norm(), 1e-6);
  EXPECT_NE(catchError("EDGE_SE3_PRIOR 0 3 1 2 3 0 0 0 1" + kI3).find("parameter 3"), std::string::npos);
}

TEST(GraphFile, AFixedLandmarkStaysAndTurnsNothing) {
  const std::string text =
      "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 1.5\nVERTEX_XY 7 2 0.5\nEDGE_SE2 0 1 1 0 1.5 100 0 0 100 0 400\n"
      "EDGE_SE2_XY 1 7 0.5 -1.1 100 0 100\nEDGE_SE2_XY 0 7 2.1 0.6 100 0 100\nFIX 0 7\n";
  const G2oGraph graph = parseG2o(text, "g.g2o");
  const FileProblem<2> file = parsed<2>(text);
  const Solution<2> solution = solve(file.problem, {});
  const G2oGraph made = withPoses(graph, file, solution.poses);
  EXPECT_EQ(made.vertices[0].values, graph.vertices[0].values);
  EXPECT_EQ(made.points[0].values, graph.points[0].values);
  EXPECT_NEAR(costOfLines(made), solution.cost, 1e-9 * solution.cost);
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const double step : {-1e-4, 1e-4}) {
      G2oGraph moved = made;
      moved.vertices[1].values[axis] += step;
      EXPECT_GT(costOfLines(moved), solution.cost) << axis;
    }
}

TEST(GraphFile, AFileWithoutEdgesIsRefused) {
  EXPECT_NE(catchError("VERTEX_SE2 0 0 0 0\n").find("without edges"), std::string::npos);
  EXPECT_NE(catchError(""), "");
}

template <int D>
void expectRoundTrip(const std::string& text) {
  const G2oGraph graph = parseG2o(text, "g.g2o");
  const FileProblem<D> file = makeProblem<D>(graph, "g.g2o");
  Dice dice(3);
  std::vector<Rigid<D>> poses;
  for (std::size_t i = 0; i < file.ids.size(); ++i) poses.push_back(drawRigid<D>(dice, 5.0, 1.0));
  const G2oGraph made = withPoses(graph, file, poses);
  EXPECT_EQ(made.edges.size(), graph.edges.size());
  EXPECT_EQ(made.vertices.size(), file.ids.size());
  for (std::size_t i = 0; i < graph.vertices.size(); ++i) EXPECT_EQ(made.vertices[i].id, graph.vertices[i].id);
  const FileProblem<D> again = makeProblem<D>(parseG2o(urban_nav_core::printG2o(made), "again"), "again");
  EXPECT_EQ(again.ids, file.ids);
  EXPECT_TRUE(again.notes.empty());
  EXPECT_LT(largestDifference(again.problem.poses, poses), 1e-14);
}
TEST(GraphFile, PosesGoBackToTheirVertices) {
  expectRoundTrip<2>(kPlane);
  expectRoundTrip<3>(kSpace);
}

TEST(GraphFile, RigidsAndPosesAreOne) {
  Dice dice(4);
  for (int run = 0; run < 20; ++run) {
    const Rigid<2> plane = drawRigid<2>(dice, 5.0, 2.0);
    const Rigid<3> space = drawRigid<3>(dice, 5.0, 2.0);
    EXPECT_LT(largestDifference<2>({toRigid<2>(toPose(plane))}, {plane}), 1e-14);
    EXPECT_LT(largestDifference<3>({toRigid<3>(toPose(space))}, {space}), 1e-14);
  }
}

/// A file that the reader accepts is relaxed without NaN.
template <int D>
void relaxed(const G2oGraph& graph) {
  const FileProblem<D> file = makeProblem<D>(graph, "fuzz");
  SolveOptions options;
  options.iterations = 5;
  const Solution<D> solution = solve(file.problem, options);
  if (allFinite(file.problem.poses) && !allFinite(solution.poses))
    throw std::runtime_error("poses that are not finite");
  withPoses(graph, file, solution.poses);
}

TEST(GraphFile, DamagedFilesAreTakenOrRefused) {
  const auto result =
      urban_nav_core::testing::fuzzText({kPlane, kSpace, kConstrained + "FIX 0 2\n"}, [](const std::string& text) {
        const G2oGraph graph = parseG2o(text, "fuzz");
        if (graph.dimension == 2) relaxed<2>(graph);
        else relaxed<3>(graph);
      });
  EXPECT_EQ(result.failure, "");
  EXPECT_GT(result.accepted, 0);
  EXPECT_GT(result.refused, 0);
}

}  // namespace
}  // namespace pose_graph::test
