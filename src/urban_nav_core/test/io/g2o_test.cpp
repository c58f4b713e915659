// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/g2o.hpp"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include "io/reader_check.hpp"
#include "urban_nav_core/geometry/compose.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/testing/numeric_jacobian.hpp"

namespace urban_nav_core {
namespace {

const char* const kG2oPlane =
    "VERTEX_SE2 0 0 0 0\n"
    "VERTEX_SE2 1   1.5 0.25\t-3.1\n"
    "FIX 0\n"
    "EDGE_SE2 0 1 1.5 0.25 -3.1 50 1 2 60 3 100   \n"
    "# a remark\n"
    "PARAMS_X 0  1 2\n";
const char* const kG2oSpace =
    "VERTEX_SE3:QUAT 7 1 2 3 0 0 0.6 0.800001\n"
    "EDGE_SE3:QUAT 7 8 1 2 3 0.5 0.5 0.5 0.5 1 0 0 0 0 0 2 0 0 0 0 3 0 0 0 4 0 0 5 0 6\n";

TEST(G2o, ReadsThePlane) {
  const G2oGraph graph = parseG2o(kG2oPlane, "g.g2o");
  EXPECT_EQ(graph.dimension, 2);
  ASSERT_EQ(graph.vertices.size(), 2U);
  ASSERT_EQ(graph.edges.size(), 1U);
  EXPECT_EQ(graph.fixed, std::vector<G2oGraph::Id>{0});
  EXPECT_EQ(graph.others, (std::vector<std::string>{"# a remark", "PARAMS_X 0  1 2"}));
  EXPECT_TRUE(isApprox(graph.pose(graph.vertices[1]), Pose(expSo3({0, 0, -3.1}), {1.5, 0.25, 0}), 1e-15));
  Eigen::Matrix3d expected;
  expected << 50, 1, 2, 1, 60, 3, 2, 3, 100;
  EXPECT_EQ(g2oInformation(graph.edges[0], 2), Eigen::MatrixXd(expected));
}

TEST(G2o, ReadsSpaceAndNormalisesOnlyOnRequest) {
  const G2oGraph graph = parseG2o(kG2oSpace, "g.g2o");
  EXPECT_EQ(graph.dimension, 3);
  EXPECT_EQ(graph.vertices[0].values[6], 0.800001);
  EXPECT_NEAR(graph.pose(graph.vertices[0]).q().norm(), 1.0, 1e-15);
  EXPECT_EQ(g2oInformation(graph.edges[0], 3).diagonal(), (Vector6d() << 1, 2, 3, 4, 5, 6).finished());
}

TEST(G2o, RoundTripKeepsNumbersAndOrder) {
  const std::string text = printG2o(parseG2o(kG2oPlane, "g.g2o"));
  EXPECT_EQ(
      text,
      "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1.5 0.25 -3.1\nFIX 0\nEDGE_SE2 0 1 1.5 0.25 -3.1 50 1 2 60 3 100\n# a remark\n"
      "PARAMS_X 0  1 2\n");
  EXPECT_EQ(printG2o(parseG2o(text, "g.g2o")), text);
  EXPECT_EQ(printG2o(parseG2o(kG2oSpace, "g.g2o")), kG2oSpace);
}

TEST(G2o, GraphsMadeHereArePrintedToo) {
  G2oGraph graph;
  G2oGraph::Vertex vertex;
  vertex.id = 3;
  graph.setPose(vertex, Pose(Quaterniond::Identity(), {1, 2, 3}));
  graph.vertices.push_back(vertex);
  G2oGraph::Edge edge;
  edge.from = 3;
  edge.to = 4;
  edge.values = vertex.values;
  setG2oInformation(edge, Matrix6d::Identity());
  graph.edges.push_back(edge);
  graph.fixed.push_back(3);
  EXPECT_EQ(
      printG2o(graph),
      "VERTEX_SE3:QUAT 3 1 2 3 0 0 0 1\nEDGE_SE3:QUAT 3 4 1 2 3 0 0 0 1 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1\n"
      "FIX 3\n");
  const G2oGraph back = parseG2o(printG2o(graph), "g");
  EXPECT_EQ(g2oInformation(back.edges[0], 3), Eigen::MatrixXd(Matrix6d::Identity()));
}

TEST(G2o, NamesFileAndLine) {
  const auto error = [](const std::string& text, UnknownTags unknown = UnknownTags::Keep) {
    return catchError([&] { parseG2o(text, "g.g2o", unknown); });
  };
  EXPECT_EQ(error("\nVERTEX_SE2 0 1 2\n"), "g.g2o:2: VERTEX_SE2 with 4 columns: expected 5");
  EXPECT_EQ(error("EDGE_SE2 0 1 1 1 1 1 1 1 1 1\n"), "g.g2o:1: EDGE_SE2 with 11 columns: expected 12");
  EXPECT_EQ(error("VERTEX_SE2 0.5 1 2 3\n"), "g.g2o:1: vertex `0.5`: expected whole numbers");
  EXPECT_EQ(error("VERTEX_SE2 0 1 2 nan\n"), "g.g2o:1: `nan`: expected a finite number");
  EXPECT_EQ(error("VERTEX_SE2 0 1 2 3\nVERTEX_SE2 0 1 2 3\n"), "g.g2o:2: duplicate vertex 0");
  EXPECT_EQ(error("VERTEX_SE3:QUAT 0 1 2 3 0 0 0 0\n"), "g.g2o:1: a quaternion of length 0: expected length 1 (1 %)");
  EXPECT_EQ(error(std::string(kG2oPlane) + kG2oSpace), "g.g2o:7: SE2 and SE3 in one file: expected one of them");
  EXPECT_EQ(error("FIX\n"), "g.g2o:1: FIX without a vertex: expected FIX id");
  EXPECT_EQ(error("EDGE_SE3_PRIOR 0 0 1 2 3 0 0 0 1 1\n"), "g.g2o:1: EDGE_SE3_PRIOR with 11 columns: expected 31");
  EXPECT_EQ(error("VERTEX_XY 0 1 2\nVERTEX_SE2 0 1 2 3\n"), "g.g2o:2: duplicate vertex 0");
  EXPECT_EQ(
      error(kG2oPlane, UnknownTags::Refuse),
      "g.g2o:6: unknown tag PARAMS_X: expected VERTEX_SE2, VERTEX_SE3:QUAT, EDGE_SE2, EDGE_SE3:QUAT, FIX, VERTEX_XY, "
      "EDGE_SE2_XY, VERTEX_TRACKXYZ, EDGE_SE3_TRACKXYZ, EDGE_PRIOR_SE2, EDGE_PRIOR_SE2_XY, EDGE_SE3_PRIOR, "
      "PARAMS_SE3OFFSET");
}

const char* const kG2oConstraintsOfThePlane =
    "VERTEX_SE2 -3 0 0 0\nVERTEX_XY 9 1 2\nEDGE_SE2_XY -3 9 1 2 5 0.5 6\nEDGE_PRIOR_SE2 -3 1 2 0.5 1 0 0 2 0 3\n"
    "EDGE_PRIOR_SE2_XY -3 1 2 4 0.5 5\nEDGE_SE2 -3 -3 1 0 0 1 0 0 1 0 1\n";
const char* const kG2oConstraintsOfSpace =
    "VERTEX_TRACKXYZ 9 1 2 3\nPARAMS_SE3OFFSET 4 1 0 0 0 0 0 1\nEDGE_SE3_TRACKXYZ 0 9 4 1 2 3 1 0 0 2 0 3\n"
    "EDGE_SE3_PRIOR 0 4 1 2 3 0 0 0 1 1 0 0 0 0 0 2 0 0 0 0 3 0 0 0 4 0 0 5 0 6\n";

TEST(G2o, ReadsLandmarksPriorsAndSensors) {
  const G2oGraph plane = parseG2o(kG2oConstraintsOfThePlane, "g", UnknownTags::Refuse);
  ASSERT_EQ(plane.points.size(), 1U);
  EXPECT_EQ(plane.points[0].values, (std::array<double, 3>{1, 2, 0}));
  ASSERT_EQ(plane.point_edges.size(), 1U);
  EXPECT_EQ(plane.point_edges[0].to, 9);
  EXPECT_EQ(plane.point_edges[0].information[2], 6.0);
  ASSERT_EQ(plane.priors.size(), 2U);
  EXPECT_FALSE(plane.priors[0].position);
  EXPECT_TRUE(plane.priors[1].position);
  EXPECT_EQ(plane.priors[1].vertex, -3);
  EXPECT_EQ(plane.priors[1].information[2], 5.0);
  EXPECT_EQ(printG2o(plane), kG2oConstraintsOfThePlane);
  const G2oGraph space = parseG2o(kG2oConstraintsOfSpace, "g", UnknownTags::Refuse);
  EXPECT_EQ(space.dimension, 3);
  EXPECT_EQ(space.point_edges[0].parameter, 4);
  EXPECT_EQ(space.priors[0].parameter, 4);
  EXPECT_TRUE(isApprox(space.pose(space.offsets[0]), Pose(Quaterniond::Identity(), {1, 0, 0}), 1e-15));
  EXPECT_EQ(printG2o(space), kG2oConstraintsOfSpace);
}

TEST(G2o, ByteOrderMarksAndCommentsAfterNumbersAreSkipped) {
  const G2oGraph graph =
      parseG2o("\xEF\xBB\xBFVERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 0 # a remark\nVERTEX_SE2 2 1 0 3#4\n", "g",
               UnknownTags::Refuse);
  ASSERT_EQ(graph.vertices.size(), 3U);
  EXPECT_EQ(graph.vertices[2].values[2], 3.0);
  EXPECT_TRUE(graph.others.empty());
}

TEST(G2o, UnknownTagsAreCounted) {
  const G2oGraph graph = parseG2o("# A\nEDGE_A 1\nEDGE_B 2\nEDGE_A 3\n", "g");
  EXPECT_EQ(unknownTags(graph), (std::vector<std::pair<std::string, std::size_t>>{{"EDGE_A", 2}, {"EDGE_B", 1}}));
}

TEST(G2o, InformationMovesToTheConventionOfStages) {
  const Pose Z(expSo3({0.3, -1.1, 0.8}), {2.0, -1.0, 0.5});
  // Error of g2o for a measurement perturbed by d in the box convention.
  const auto error = [&Z](const Vector6d& d) -> Vector6d {
    const Pose E = Z.inverse() * boxPlus(Z, d);
    Vector6d e;
    e << E.t(), (E.q().w() < 0.0 ? -1.0 : 1.0) * E.q().vec();
    return e;
  };
  const Matrix6d J = testing::numericJacobian<6, 6>(error, Vector6d(Vector6d::Zero()));
  Matrix6d g2o = Matrix6d::Identity() * 3.0 + Matrix6d::Constant(0.4);
  g2o(0, 0) = 9.0;
  EXPECT_LE((J.transpose() * g2o * J - boxFromG2oInformation(g2o, Z)).norm(), 1e-9);
  EXPECT_LE((g2oFromBoxInformation(boxFromG2oInformation(g2o, Z), Z) - g2o).norm(), 1e-13);
}

TEST(G2o, RealGraphsRoundTrip) {
  const char* data = std::getenv("URBAN_NAV_DATA");
  const std::string folder = std::string(data == nullptr ? "" : data) + "/graphs";
  if (data == nullptr || !std::filesystem::exists(folder)) GTEST_SKIP() << "URBAN_NAV_DATA names no folder with graphs";
  const std::string path =
      (std::filesystem::temp_directory_path() / ("urban_nav_g2o_" + std::to_string(::getpid()))).string();
  struct Expected {
    const char* name;
    std::size_t vertices, edges;
  };
  for (const Expected& expected : {Expected{"smallGrid3D", 125, 297},
                                   {"manhattan", 0, 5453},
                                   {"intel", 1728, 2512},
                                   {"parking-garage", 1661, 6275}}) {
    const std::string packed = folder + "/" + expected.name + ".g2o.xz";
    if (std::system(("xz -dc '" + packed + "' > '" + path + "'").c_str()) != 0) GTEST_SKIP() << "xz is not installed";
    const G2oGraph graph = readG2o(path, UnknownTags::Refuse);
    EXPECT_EQ(graph.vertices.size(), expected.vertices) << expected.name;
    EXPECT_EQ(graph.edges.size(), expected.edges) << expected.name;
    const std::string text = printG2o(graph);
    EXPECT_EQ(printG2o(parseG2o(text, "again")), text) << expected.name;
  }
  std::filesystem::remove(path);
}

TEST(G2o, Fuzzed) {
  expectSurvives(testing::fuzzText({kG2oPlane, kG2oSpace, kG2oConstraintsOfThePlane, kG2oConstraintsOfSpace},
                                   [](const std::string& text) {
                                     const G2oGraph graph = parseG2o(text, "g");
                                     for (const auto& vertex : graph.vertices) {
                                       if (!graph.pose(vertex).isFinite())
                                         throw std::runtime_error("a pose that is not finite");
                                     }
                                     const std::string printed = printG2o(graph);
                                     if (printG2o(parseG2o(printed, "again")) != printed)
                                       throw std::runtime_error("no round trip");
                                   }));
}

}  // namespace
}  // namespace urban_nav_core
