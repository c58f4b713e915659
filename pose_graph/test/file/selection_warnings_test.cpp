// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/selection_warnings.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace pose_graph {
namespace {

// Two chains of four poses, one closure within the first and two between them.
struct TwoChains {
  FileProblem<2> file;
  RobustSolution<2> robust;

  TwoChains() {
    for (const auto& [from, to] : {std::pair{0, 1}, {1, 2}, {2, 3}, {4, 5}, {5, 6}, {6, 7}, {0, 3}, {1, 4}, {2, 6}}) {
      Edge<2> edge;
      edge.from = from;
      edge.to = to;
      file.problem.edges.push_back(edge);
      file.roles.push_back(to == from + 1 ? EdgeRole::Trusted : EdgeRole::Candidate);
      file.edges.push_back(static_cast<int>(file.edges.size()));
    }
    file.problem.poses.resize(8);
    file.ids = {0, 1, 2, 3, 4, 5, 6, 7};
    robust.edges.resize(file.roles.size());
    for (EdgeAssessment& edge : robust.edges) edge.verdict = urban_nav_core::ClosureVerdict::Accepted;
  }
  void reject(int from, int to) {
    for (std::size_t e = 0; e < file.roles.size(); ++e)
      if (file.problem.edges[e].from == from && file.problem.edges[e].to == to)
        robust.edges[e].verdict = urban_nav_core::ClosureVerdict::Rejected;
  }
  bool warns(const std::string& words) const {
    const auto warnings = selectionWarnings(file, robust, {});
    return std::any_of(warnings.begin(), warnings.end(),
                       [&](const std::string& warning) { return warning.find(words) != std::string::npos; });
  }
};

TEST(SelectionWarnings, NameTheClosuresWithoutWhichPartsStayApart) {
  TwoChains graph;
  EXPECT_FALSE(graph.warns("apart"));
  graph.reject(0, 3);  // within a part
  EXPECT_FALSE(graph.warns("apart"));
  graph.reject(1, 4);
  EXPECT_FALSE(graph.warns("apart")) << "the other one still joins them";
  graph.reject(2, 6);
  EXPECT_TRUE(graph.warns("2 parts of the graph that odometry does not join stay apart: all 2 closures between them"));
}

TEST(SelectionWarnings, AreLimitedToOneWhereNothingCouldBeDecided) {
  TwoChains graph;
  graph.robust.selection.undecided = true;
  for (const auto& [from, to] : {std::pair{0, 3}, {1, 4}, {2, 6}}) graph.reject(from, to);
  EXPECT_TRUE(graph.warns("nothing could be decided"));
  EXPECT_FALSE(graph.warns("apart"));
}

TEST(SelectionWarnings, NameTheScaleOnlyWhereItMatters) {
  TwoChains graph;
  const auto warnings = [&](double odometry, double closures) {
    DeviationScales scales;
    scales.odometry_translation = odometry;
    scales.closure_translation = closures;
    return selectionWarnings(graph.file, graph.robust, scales);
  };
  EXPECT_TRUE(warnings(0.2, 0.3).empty()) << "careful";
  EXPECT_TRUE(warnings(1.5, 0.6).empty());
  ASSERT_EQ(warnings(4.0, 1.0).size(), 1u);
  EXPECT_NE(warnings(4.0, 1.0)[0].find("divide its information by 16"), std::string::npos);
  ASSERT_EQ(warnings(0.2, 0.9).size(), 1u);
  EXPECT_NE(warnings(0.2, 0.9)[0].find("weighted inconsistently"), std::string::npos);
  EXPECT_EQ(warnings(5.0, 5.0).size(), 2u);
}

TEST(SelectionWarnings, NameAGuess) {
  SelectionReport selection;
  EXPECT_TRUE(selectionWarnings(selection, 3, 10).empty());
  selection.has_rival = true;
  ASSERT_EQ(selectionWarnings(selection, 3, 10).size(), 1u);
  EXPECT_NE(selectionWarnings(selection, 3, 10)[0].find("nearly as likely"), std::string::npos);
  selection.odometry_factor = 9.0;
  EXPECT_NE(selectionWarnings(selection, 3, 10)[0].find("odometry are 3 times the stated"), std::string::npos);
}

}  // namespace
}  // namespace pose_graph
