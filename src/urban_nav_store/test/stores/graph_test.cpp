// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_store/graph_store.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "support/contents.hpp"
#include "support/folder.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav_store {

using urban_nav_core::ClosureVerdict;

namespace {

using testing::Drawn;
using testing::expectError;
using testing::Folder;

class GraphRows : public ::testing::Test {
 protected:
  const Folder folder;
  const std::string path = folder.file("s.db");
  Store store{path, Access::Write};
  GraphStore& graph = store.graph();
  Drawn drawn{1};
};

bool sameBits(const urban_nav_core::Pose& a, const urban_nav_core::Pose& b) {
  return a.t() == b.t() && a.q().coeffs() == b.q().coeffs();
}

TEST_F(GraphRows, NodesKeepConstantsOfTheRig) {
  Node node = drawn.node(7), plain = drawn.node(8);
  node.constants = {{"disparity", 0.1, -0.2, 0.3, urban_nav_core::Vector6d::LinSpaced(1.0 / 3.0, 2.0)},
                    {"scale", 0.0, 0.0, 5e-4, urban_nav_core::Vector6d::Unit(1)}};
  graph.put("a", node);
  graph.put("a", plain);
  store.commit();
  const Node found = graph.node({"a", 7}).value();
  ASSERT_EQ(found.constants.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_TRUE(isApprox(found.constants[i], node.constants[i], 0.0));
  EXPECT_TRUE(graph.node({"a", 8})->constants.empty());
  node.constants[1].sensitivity[2] = std::nan("");
  EXPECT_THROW(graph.put("a", node), urban_nav_core::UserError);
}

TEST_F(GraphRows, NodesComeBackBitByBitInOrder) {
  std::vector<Node> nodes;
  for (int i = 0; i < 100; ++i) nodes.push_back(drawn.node(1000 - 10 * i));
  for (const Node& node : nodes) graph.put("a", node);
  graph.put("b", drawn.node(5));
  store.commit();
  std::size_t next = nodes.size();
  graph.forEachNode("a", [&](const Node& node) {
    const Node& written = nodes[--next];
    EXPECT_EQ(node.stamp, written.stamp);
    EXPECT_TRUE(sameBits(node.T_odom_base, written.T_odom_base));
    EXPECT_EQ(node.covariance, written.covariance);
    EXPECT_EQ(node.drift_covariance, written.drift_covariance);
    EXPECT_EQ(node.status, written.status);
  });
  EXPECT_EQ(next, 0U);
  EXPECT_EQ(graph.nodes("a"), 100);
  EXPECT_EQ(graph.nodes("c"), 0);
  std::vector<urban_nav_core::StampNs> part;
  graph.forEachNode(
      "a", [&](const Node& node) { part.push_back(node.stamp); }, 500, 520);
  EXPECT_EQ(part, (std::vector<urban_nav_core::StampNs>{500, 510, 520}));
  EXPECT_EQ(graph.node({"b", 5})->stamp, 5);
  EXPECT_FALSE(graph.node({"b", 6}));
}

TEST_F(GraphRows, EdgesComeBackAndAreTheirKey) {
  const NodeRef a{"a", 1}, b{"b", 2};
  for (const EdgeKind kind :
       {EdgeKind::Odometry, EdgeKind::Stereo, EdgeKind::Icp, EdgeKind::Plane, EdgeKind::Session, EdgeKind::Asserted}) {
    Edge edge = drawn.edge(a, b, kind);
    graph.put(edge);
    edge.verdict = ClosureVerdict::Waiting;
    edge.measured.information.setZero();  // singular is allowed
    graph.put(edge);
    edge.source = "another";
    graph.put(edge);
    EXPECT_EQ(parseEdgeKind(toString(kind)), kind);
  }
  std::vector<Edge> edges;
  graph.forEachEdge("a", [&](const Edge& edge) { edges.push_back(edge); });
  ASSERT_EQ(edges.size(), 12U);
  for (const Edge& edge : edges) {
    EXPECT_EQ(edge.a, a);
    EXPECT_EQ(edge.b, b);
    EXPECT_EQ(edge.verdict, ClosureVerdict::Waiting);
    EXPECT_TRUE(edge.measured.information.isZero());
    EXPECT_EQ(edge.reason, "too far, \"perhaps\"");
    graph.putEvidence(edge, edge.source + toString(edge.kind));
  }
  for (const Edge& edge : edges) EXPECT_EQ(graph.evidence(edge), edge.source + toString(edge.kind));
  graph.remove(edges[3]);
  graph.remove(edges[3]);
  EXPECT_FALSE(graph.evidence(edges[3]));
  std::size_t left = 0;
  graph.forEachEdge("a", [&](const Edge&) { ++left; });
  EXPECT_EQ(left, 11U);
}

TEST_F(GraphRows, RelaxedPosesAreReplaced) {
  RelaxedPose pose = drawn.relaxed(7);
  graph.put("a", pose);
  pose = drawn.relaxed(7);
  pose.revision = 8;
  graph.put("a", pose);
  std::size_t seen = 0;
  graph.forEachRelaxed("a", [&](const RelaxedPose& each) {
    ++seen;
    EXPECT_EQ(each.revision, 8);
    EXPECT_TRUE(sameBits(each.T_map_base, pose.T_map_base));
  });
  EXPECT_EQ(seen, 1U);
}

TEST_F(GraphRows, NoNumberThatIsNoneGetsIn) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, inf, -inf}) {
    Node node = drawn.node(1'500'000'000);
    node.T_odom_base = urban_nav_core::Pose(node.T_odom_base.q(), {1.0, bad, 2.0});
    expectError([&] { graph.put("a", node); }, path,
                "the row of node with session=a, stamp_ns=1500000000 is invalid: y is not finite");
    node = drawn.node(1);
    node.covariance(3, 4) = bad;
    expectError([&] { graph.put("a", node); }, path, "not finite");
    RelaxedPose relaxed = drawn.relaxed(1);
    relaxed.T_map_base = urban_nav_core::Pose(relaxed.T_map_base.q(), {bad, 0, 0});
    expectError([&] { graph.put("a", relaxed); }, path, "the row of relaxed with session=a");
    Edge edge = drawn.edge({"a", 1}, {"a", 2}, EdgeKind::Icp);
    edge.weight = bad;
    expectError([&] { graph.put(edge); }, path, "the row of edge with session_a=");
    edge = drawn.edge({"a", 1}, {"a", 2}, EdgeKind::Icp);
    edge.measured.information(0, 0) = bad;
    expectError([&] { graph.put(edge); }, path, "not finite");
  }
  EXPECT_EQ(graph.nodes("a"), 0);
}

TEST_F(GraphRows, MinusZeroIsZero) {
  Node node;
  node.T_odom_base = urban_nav_core::Pose(urban_nav_core::Quaterniond(1.0, -0.0, 0.0, -0.0), {-0.0, 1.0, -0.0});
  graph.put("a", node);
  store.commit();
  EXPECT_FALSE(std::signbit(graph.node({"a", 0})->T_odom_base.t().x()));
}

}  // namespace
}  // namespace urban_nav_store
