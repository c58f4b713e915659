// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "manifold/rotation.hpp"
#include "pose_graph/graph_file.hpp"
#include "pose_graph/problem.hpp"
#include "urban_nav_core/testing/dice.hpp"
#include "urban_nav_core/testing/graphs.hpp"

namespace pose_graph::test {

using urban_nav_core::testing::Dice;

template <int D>
Tangent<D> drawTangent(Dice& dice, double metres, double radians) {
  Tangent<D> d;
  for (int i = 0; i < kTangentSize<D>; ++i) d[i] = (i < D ? metres : radians) * dice.normal();
  return d;
}

template <int D>
Rigid<D> drawRigid(Dice& dice, double metres, double radians) {
  return moved(Rigid<D>(), drawTangent<D>(dice, metres, radians));
}

/// Draws information of full rank or of this rank, elongated and with cross terms.
template <int D>
TangentMatrix<D> drawInformation(Dice& dice, int rank = kTangentSize<D>) {
  TangentMatrix<D> sum = TangentMatrix<D>::Zero();
  for (int i = 0; i < rank; ++i) {
    const Tangent<D> d = drawTangent<D>(dice, 1.0, 3.0);
    sum += d * d.transpose();
  }
  return sum;
}

/// Draws poses along a random walk and edges with these deviations: the chain, one edge of it backwards and one twice,
/// and `closures` edges between any two poses.
template <int D>
Problem<D> drawProblem(Dice& dice, int poses, int closures, double metres, double radians) {
  Problem<D> made;
  made.poses.push_back(drawRigid<D>(dice, 5.0, 1.0));
  for (int i = 1; i < poses; ++i) {
    Tangent<D> step = drawTangent<D>(dice, 0.1, 0.3);
    step[0] += 1.0;
    made.poses.push_back(made.poses.back() * moved(Rigid<D>(), step));
  }
  const auto measure = [&](int from, int to) {
    const Rigid<D> exact =
        made.poses[static_cast<std::size_t>(from)].inverse() * made.poses[static_cast<std::size_t>(to)];
    made.edges.push_back({from, to, moved(exact, drawTangent<D>(dice, metres, radians)), drawInformation<D>(dice)});
  };
  for (int i = 1; i < poses; ++i) i % 4 == 3 ? measure(i, i - 1) : measure(i - 1, i);
  if (poses > 2) measure(1, 2);
  for (int i = 0; i < closures && poses > 2;) {
    const int from = static_cast<int>(dice.below(static_cast<std::size_t>(poses)));
    const int to = static_cast<int>(dice.below(static_cast<std::size_t>(poses)));
    if (from == to) continue;
    measure(from, to);
    ++i;
  }
  return made;
}

/// Converts a simulated graph to a problem with these initial poses. The information of a simulated edge is in the
/// parent's axes.
template <int D>
Problem<D> simulatedProblem(const urban_nav_core::testing::SimulatedGraph& graph,
                            const std::vector<urban_nav_core::Pose>& guess) {
  Problem<D> made;
  for (const urban_nav_core::Pose& pose : guess) made.poses.push_back(toRigid<D>(pose));
  for (const urban_nav_core::testing::GraphEdge& edge : graph.edges) {
    urban_nav_core::Matrix6d turn = urban_nav_core::Matrix6d::Zero();
    turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = edge.T_a_b.R();
    const urban_nav_core::Matrix6d turned = turn.transpose() * edge.information * turn;
    TangentMatrix<D> information;
    if constexpr (D == 3) {
      information = turned;
    } else {
      const int kept[3] = {0, 1, 5};
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) information(i, j) = turned(kept[i], kept[j]);
    }
    made.edges.push_back({static_cast<int>(edge.a), static_cast<int>(edge.b), toRigid<D>(edge.T_a_b), information});
  }
  return made;
}

/// Returns the largest difference of two lists of poses, in m and matrix elements.
template <int D>
double largestDifference(const std::vector<Rigid<D>>& a, const std::vector<Rigid<D>>& b) {
  EXPECT_EQ(a.size(), b.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max({largest, (a[i].R - b[i].R).norm(), (a[i].t - b[i].t).norm()});
  return largest;
}

template <int D>
bool allFinite(const std::vector<Rigid<D>>& poses) {
  for (const Rigid<D>& pose : poses)
    if (!pose.R.allFinite() || !pose.t.allFinite()) return false;
  return true;
}

}  // namespace pose_graph::test
