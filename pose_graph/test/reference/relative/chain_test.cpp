// SPDX-License-Identifier: BSD-3-Clause
#include "relative/chain.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "small_graph.hpp"
#include "urban_nav_core/types/error.hpp"

namespace pose_graph {
namespace {

using test::smallGraph;

template <int D>
std::string catchError(const Problem<D>& problem) {
  try {
    makeChain(problem);
  } catch (const urban_nav_core::UserError& error) {
    return error.what();
  }
  return "";
}

template <int D>
void expectSorted() {
  const Problem<D> problem = smallGraph<D>(12, 7, 0.1, 0.1);
  const Chain<D> chain = makeChain(problem);
  EXPECT_EQ(chain.links, 11);
  ASSERT_EQ(chain.link_edges.size(), 12U) << "one link is measured twice";
  for (std::size_t i = 1; i < chain.link_edges.size(); ++i)
    EXPECT_LE(chain.link_edges[i - 1].link, chain.link_edges[i].link);
  ASSERT_EQ(chain.closures.size(), 7U);
  for (const auto& closure : chain.closures)
    EXPECT_LE((closure.root.transpose() * closure.root - problem.edges[closure.edge].information).norm(), 1e-12);
}

TEST(Chain, SeparatesLinkEdgesAndClosures) {
  expectSorted<2>();
  expectSorted<3>();
}

TEST(Chain, IsEmptyWherePosesAreFew) {
  EXPECT_EQ(makeChain(Problem<3>()).links, 0);
  Problem<3> one;
  one.poses.resize(1);
  EXPECT_EQ(makeChain(one).links, 0);
}

TEST(Chain, ReportsInvalidProblems) {
  const Problem<3> good = smallGraph<3>(6, 2, 0.1, 0.1);
  EXPECT_EQ(catchError(good), "");
  const std::size_t closure = good.edges.size() - 1;
  const std::string name = "edge " + std::to_string(closure) + " (" + std::to_string(good.edges[closure].from) +
                           " to " + std::to_string(good.edges[closure].to) + ")";

  Problem<3> bad = good;
  bad.poses[4].t.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(catchError(bad), "pose 4 is not finite");
  bad = good;
  bad.edges[closure].Z.R(1, 1) = std::numeric_limits<double>::infinity();
  EXPECT_EQ(catchError(bad), name + " is not finite");
  bad = good;
  bad.edges[0].to = 6;
  EXPECT_EQ(catchError(bad), "edge 0 (0 to 6) refers to a missing pose: expected 0...5");
  bad = good;
  bad.edges[0].to = 0;
  EXPECT_EQ(catchError(bad), "edge 0 (0 to 0) goes from a pose to itself");
  bad = good;
  bad.edges[closure].information(2, 2) = -5.0;
  EXPECT_EQ(catchError(bad).substr(0, name.size() + 27), name + " has indefinite information");
  bad.edges[closure].information.setIdentity();
  bad.edges[closure].information *= -1.0;
  EXPECT_NE(catchError(bad), "");
}

TEST(Chain, WantsEveryLinkHeldInEveryDirection) {
  Problem<2> problem = smallGraph<2>(6, 2, 0.1, 0.1);
  problem.edges[3].information = Eigen::Vector3d(4.0, 4.0, 0.0).asDiagonal();
  EXPECT_NE(catchError(problem).find("the chain leaves a direction free between poses 3 and 4"), std::string::npos);
  Edge<2> heading = problem.edges[3];
  std::swap(heading.from, heading.to);
  heading.Z = heading.Z.inverse();
  heading.information = Eigen::Vector3d(0.0, 0.0, 9.0).asDiagonal();
  problem.edges.push_back(heading);
  EXPECT_EQ(catchError(problem), "") << "two edges together hold it";
  problem.edges.erase(problem.edges.begin());
  EXPECT_NE(catchError(problem).find("the chain is broken between poses 0 and 1"), std::string::npos);
}

}  // namespace
}  // namespace pose_graph
