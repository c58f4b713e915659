// SPDX-License-Identifier: BSD-3-Clause
#include "linear/front.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "urban_nav_core/geometry/dense.hpp"
#include "urban_nav_core/testing/dice.hpp"

namespace pose_graph {
namespace {

using urban_nav_core::testing::Dice;

Eigen::MatrixXd positiveDefinite(int size, Dice& dice) {
  Eigen::MatrixXd A(size, size);
  for (Eigen::Index i = 0; i < A.size(); ++i) A(i) = dice.normal();
  return A * A.transpose() + Eigen::MatrixXd::Identity(size, size);
}

void fill(Front& front, const Eigen::MatrixXd& A) {
  front.reset(static_cast<int>(A.rows()));
  for (int j = 0; j < front.size(); ++j)
    for (int i = j; i < front.size(); ++i) front.column(j)[i] = A(i, j);
}

/// Returns the leading columns of L and the Schur complement, by plain formulas.
Eigen::MatrixXd expected(const Eigen::MatrixXd& A, int pivots) {
  const Eigen::Index rest = A.rows() - pivots;
  Eigen::MatrixXd L = A.topLeftCorner(pivots, pivots);
  EXPECT_TRUE(urban_nav_core::choleskyInPlace(L));
  Eigen::MatrixXd below = A.bottomLeftCorner(rest, pivots);
  urban_nav_core::solveLowerTransposedFromRightInPlace(L, below);
  Eigen::MatrixXd made = A;
  made.topLeftCorner(pivots, pivots) = L;
  made.bottomLeftCorner(rest, pivots) = below;
  made.bottomRightCorner(rest, rest) -= below * below.transpose();
  return made;
}

TEST(Front, EliminatesLikeTheDenseFormula) {
  Dice dice(1);
  Front front;
  for (const int size : {1, 2, 7, 8, 9, 16, 17, 47, 48, 49, 56, 95, 96, 97, 105, 150}) {
    const Eigen::MatrixXd A = positiveDefinite(size, dice);
    for (const int pivots : {1, 3, 8, 9, 47, 48, 49, 96, 97, size}) {
      if (pivots > size) continue;
      fill(front, A);
      ASSERT_TRUE(front.eliminate(pivots));
      const Eigen::MatrixXd wanted = expected(A, pivots);
      double worst = 0.0;
      for (int j = 0; j < size; ++j)
        for (int i = j; i < size; ++i) worst = std::max(worst, std::abs(front.column(j)[i] - wanted(i, j)));
      EXPECT_LT(worst, 1e-10 * size) << size << " rows, " << pivots << " pivots";
    }
  }
}

TEST(Front, RefusesWhatIsNotPositiveDefinite) {
  Dice dice(2);
  Front front;
  for (const int bad : {0, 5, 47, 48, 60}) {
    for (const double value : {0.0, -1.0, -std::numeric_limits<double>::infinity(),
                               std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
      Eigen::MatrixXd A = positiveDefinite(61, dice);
      A(bad, bad) = value;
      fill(front, A);
      EXPECT_FALSE(front.eliminate(61)) << bad << " " << value;
    }
    Eigen::MatrixXd A = positiveDefinite(61, dice);
    if (bad == 60) continue;
    A(60, bad) = std::numeric_limits<double>::quiet_NaN();
    fill(front, A);
    EXPECT_FALSE(front.eliminate(61)) << bad;
  }
}

TEST(Front, IsCleanAfterReset) {
  Dice dice(3);
  Front front;
  fill(front, positiveDefinite(60, dice));
  ASSERT_TRUE(front.eliminate(30));
  const Eigen::MatrixXd A = positiveDefinite(13, dice);
  Front fresh;
  fill(front, A);
  fill(fresh, A);
  ASSERT_TRUE(front.eliminate(5) && fresh.eliminate(5));
  for (int j = 0; j < 13; ++j)
    for (int i = j; i < 13; ++i) EXPECT_EQ(front.column(j)[i], fresh.column(j)[i]);
}

}  // namespace
}  // namespace pose_graph
