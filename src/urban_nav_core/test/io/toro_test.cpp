// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/toro.hpp"

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "io/reader_check.hpp"
#include "urban_nav_core/io/text_file.hpp"

namespace urban_nav_core {
namespace {

const char* const kToroPlane =
    "VERTEX2 0 0 0 0\n"
    "VERTEX2 1   1.5 0.25\t-3.1\n"
    "EDGE2 0 1 1.5 0.25 -3.1 11 12 22 33 13 23   \n"
    "EQUIV 0 1\n";
const char* const kToroSpace =
    "VERTEX3 7 1 2 3 0.1 -0.2 2.5\n"
    "EDGE3 7 8 1 2 3 0.3 0.4 -0.5 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21\n";

TEST(Toro, ReadsThePlaneWithItsOwnOrderOfTheInformation) {
  const G2oGraph graph = parseToro(kToroPlane, "g.graph");
  EXPECT_EQ(graph.dimension, 2);
  ASSERT_EQ(graph.vertices.size(), 2U);
  ASSERT_EQ(graph.edges.size(), 1U);
  EXPECT_EQ(graph.others, std::vector<std::string>{"EQUIV 0 1"});
  EXPECT_TRUE(isApprox(graph.pose(graph.vertices[1]), Pose(expSo3({0, 0, -3.1}), {1.5, 0.25, 0}), 1e-15));
  Eigen::Matrix3d expected;
  expected << 11, 12, 13, 12, 22, 23, 13, 23, 33;
  EXPECT_EQ(g2oInformation(graph.edges[0], 2), Eigen::MatrixXd(expected));
}

TEST(Toro, ReadsSpaceWithYawOutermost) {
  const G2oGraph graph = parseToro(kToroSpace, "g.graph");
  EXPECT_EQ(graph.dimension, 3);
  const Quaterniond R = expSo3({0, 0, 2.5}) * expSo3({0, -0.2, 0}) * expSo3({0.1, 0, 0});
  EXPECT_TRUE(isApprox(graph.pose(graph.vertices[0]), Pose(R, {1, 2, 3}), 1e-15));
  // The quaternion's vector is half the angle: a quarter of the cost's scale where rotation meets rotation.
  const Eigen::MatrixXd information = g2oInformation(graph.edges[0], 3);
  EXPECT_EQ(information.diagonal(), (Vector6d() << 1, 7, 12, 4 * 16, 4 * 19, 4 * 21).finished());
  EXPECT_EQ(information(0, 5), 2 * 6);
  EXPECT_EQ(information(0, 1), 2);
  EXPECT_EQ(information(4, 5), 4 * 20);
}

TEST(Toro, TheCostOfASmallErrorIsUnchanged) {
  const G2oGraph graph = parseToro(kToroSpace, "g.graph");
  const Vector6d angles = 1e-5 * (Vector6d() << 1, -2, 3, -4, 5, -6).finished();
  const Quaterniond E = expSo3({0, 0, angles[5]}) * expSo3({0, angles[4], 0}) * expSo3({angles[3], 0, 0});
  Vector6d g2o = angles;
  g2o.tail<3>() = E.vec();
  Matrix6d toro;
  double next = 1.0;
  for (int row = 0; row < 6; ++row)
    for (int column = row; column < 6; ++column) toro(row, column) = toro(column, row) = next++;
  const double cost = angles.dot(toro * angles);
  EXPECT_NEAR(g2o.dot(g2oInformation(graph.edges[0], 3) * g2o), cost, 1e-3 * std::abs(cost));
}

TEST(Toro, RoundTripOfThePlaneKeepsEveryNumber) {
  const std::string text = printToro(parseToro(kToroPlane, "g.graph"));
  EXPECT_EQ(text, "VERTEX2 0 0 0 0\nVERTEX2 1 1.5 0.25 -3.1\nEDGE2 0 1 1.5 0.25 -3.1 11 12 22 33 13 23\nEQUIV 0 1\n");
  EXPECT_EQ(printToro(parseToro("VERTEX 3 1 2 3\nEDGE 3 4 1 2 3 1 0 1 1 0 0\n", "g")),
            "VERTEX2 3 1 2 3\nEDGE2 3 4 1 2 3 1 0 1 1 0 0\n");
}

TEST(Toro, RoundTripOfSpaceKeepsEveryNumberToTheLastBits) {
  const G2oGraph graph = parseToro(kToroSpace, "g.graph");
  const G2oGraph back = parseToro(printToro(graph), "g.graph");
  ASSERT_EQ(back.vertices.size(), graph.vertices.size());
  ASSERT_EQ(back.edges.size(), graph.edges.size());
  EXPECT_TRUE(isApprox(back.pose(back.vertices[0]), graph.pose(graph.vertices[0]), 1e-15));
  EXPECT_TRUE(isApprox(back.pose(back.edges[0]), graph.pose(graph.edges[0]), 1e-15));
  EXPECT_EQ(back.edges[0].information, graph.edges[0].information);
}

TEST(Toro, AnglesComeBackFromEveryAttitude) {
  for (const double pitch : {-0.5 * M_PI, -1.570796326, -1.2, 0.0, 0.7, 1.570796326, 0.5 * M_PI}) {
    for (const double roll : {-3.0, -0.4, 0.0, 2.0}) {
      G2oGraph graph;
      G2oGraph::Vertex vertex;
      const Pose pose(expSo3({0, 0, 1.1}) * expSo3({0, pitch, 0}) * expSo3({roll, 0, 0}), {1, 2, 3});
      graph.setPose(vertex, pose);
      graph.vertices.push_back(vertex);
      const G2oGraph back = parseToro(printToro(graph), "g");
      EXPECT_TRUE(isApprox(back.pose(back.vertices[0]), pose, 1e-14)) << "roll " << roll << ", pitch " << pitch;
    }
  }
}

TEST(Toro, GoesOverIntoG2oAndBack) {
  const std::string text = printToro(parseToro(kToroPlane, "g"));
  EXPECT_EQ(printToro(parseG2o(printG2o(parseToro(text, "g")), "g.g2o")), text);
}

TEST(Toro, NamesFileAndLine) {
  const auto error = [](const std::string& text, UnknownTags unknown = UnknownTags::Keep) {
    return catchError([&] { parseToro(text, "g.graph", unknown); });
  };
  EXPECT_EQ(error("\nVERTEX2 0 1 2\n"), "g.graph:2: VERTEX2 with 4 columns: expected 5");
  EXPECT_EQ(error("EDGE2 0 1 1 1 1 1 1 1 1 1\n"), "g.graph:1: EDGE2 with 11 columns: expected 12");
  EXPECT_EQ(error("VERTEX3 0 1 2 3\n"), "g.graph:1: VERTEX3 with 5 columns: expected 8");
  EXPECT_EQ(error("VERTEX2 1.5 1 2 3\n"), "g.graph:1: vertex `1.5`: expected whole numbers");
  EXPECT_EQ(error("VERTEX2 0 1 2 nan\n"), "g.graph:1: `nan`: expected a finite number");
  EXPECT_EQ(error("VERTEX2 0 1 2 3\nVERTEX2 0 1 2 3\n"), "g.graph:2: duplicate vertex 0");
  EXPECT_EQ(error(std::string(kToroPlane) + kToroSpace),
            "g.graph:5: plane and space in one file: expected one of them");
  EXPECT_EQ(error("FIX\n"), "g.graph:1: FIX without a vertex: expected FIX id");
  EXPECT_EQ(error(kToroPlane, UnknownTags::Refuse),
            "g.graph:4: unknown tag EQUIV: expected VERTEX2, VERTEX, EDGE2, EDGE, VERTEX3, EDGE3, FIX");
  EXPECT_NE(error("EDGE3 7 8 1 2 3 0 0 0 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1e308 0 0 1 0 1\n"), "");
}

TEST(Toro, IsDistinguishedFromG2o) {
  EXPECT_TRUE(isToro(kToroPlane));
  EXPECT_TRUE(isToro(std::string("# a remark\n\n") + kToroSpace));
  EXPECT_FALSE(isToro("VERTEX_SE2 0 0 0 0\nVERTEX2 1 0 0 0\n"));
  EXPECT_FALSE(isToro("EDGE_SE3:QUAT 0 1\n"));
  EXPECT_FALSE(isToro(""));
}

TEST(Toro, WritesWhatItReads) {
  const std::string path =
      (std::filesystem::temp_directory_path() / ("urban_nav_toro_" + std::to_string(::getpid()))).string();
  writeToro(path, parseToro(kToroPlane, "g"));
  EXPECT_EQ(printToro(readToro(path)), readTextFile(path));
  std::filesystem::remove(path);
  EXPECT_NE(catchError([&] { readToro(path); }), "");
}

TEST(Toro, Fuzzed) {
  expectSurvives(testing::fuzzText({kToroPlane, kToroSpace}, [](const std::string& text) {
    const G2oGraph graph = parseToro(text, "g");
    for (const auto& vertex : graph.vertices) {
      if (!graph.pose(vertex).isFinite()) throw std::runtime_error("a pose that is not finite");
    }
    const std::string printed = printToro(graph);
    const G2oGraph back = parseToro(printed, "again");
    if (back.lines.size() != graph.lines.size()) throw std::runtime_error("no round trip");
    if (graph.dimension == 2 && printToro(back) != printed) throw std::runtime_error("other numbers");
    isToro(text);
  }));
}

}  // namespace
}  // namespace urban_nav_core
