// SPDX-License-Identifier: BSD-3-Clause
#include "objective/whitened_edge.hpp"

#include <gtest/gtest.h>

#include "support/drawn.hpp"

namespace pose_graph {
namespace {

using test::Dice;

template <int D>
void jacobiansAreRight() {
  Dice dice(D);
  for (int i = 0; i < 30; ++i) {
    const Edge<D> edge{0, 1, test::drawRigid<D>(dice, 2.0, 0.7), test::drawInformation<D>(dice)};
    const WhitenedEdge<D> white = whitened(edge);
    const Rigid<D> from = test::drawRigid<D>(dice, 5.0, 0.7);
    const Rigid<D> to = moved(from * edge.Z, test::drawTangent<D>(dice, 0.5, 0.5));  // large residuals
    const WhitenedJacobians<D> made = whitenedJacobians(white, from, to);
    constexpr double kH = 1e-6;
    for (int a = 0; a < kTangentSize<D>; ++a) {
      const Tangent<D> step = kH * Tangent<D>::Unit(a);
      const Tangent<D> by_from =
          (whitenedError(white, moved(from, step), to) - whitenedError(white, moved<D>(from, -step), to)) / (2 * kH);
      const Tangent<D> by_to =
          (whitenedError(white, from, moved(to, step)) - whitenedError(white, from, moved<D>(to, -step))) / (2 * kH);
      EXPECT_LT((made.by_from.col(a) - by_from).norm(), 1e-6 * (1.0 + by_from.norm()));
      EXPECT_LT((made.by_to.col(a) - by_to).norm(), 1e-6 * (1.0 + by_to.norm()));
    }
  }
}
TEST(WhitenedEdge, JacobiansAreThoseOfTheErrorInThePlane) { jacobiansAreRight<2>(); }
TEST(WhitenedEdge, JacobiansAreThoseOfTheErrorInSpace) { jacobiansAreRight<3>(); }

TEST(WhitenedEdge, ItsSquareIsTheInformation) {
  Dice dice(5);
  for (int rank = 0; rank <= 6; ++rank) {
    const Edge<3> edge{0, 1, {}, test::drawInformation<3>(dice, rank)};
    const WhitenedEdge<3> white = whitened(edge);
    EXPECT_EQ(white.rank, rank);
    EXPECT_LT((white.W.transpose() * white.W - edge.information).norm(), 1e-9 * (1.0 + edge.information.norm()));
    EXPECT_EQ(white.W.bottomRows(6 - rank).norm(), 0.0);
  }
}

}  // namespace
}  // namespace pose_graph
