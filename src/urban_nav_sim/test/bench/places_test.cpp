// SPDX-License-Identifier: BSD-3-Clause
#include "../../bench/support/places.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace urban_nav_sim::bench {
namespace {

Place at(double x, double heading, double along, const Counts& words) { return {{x, 0.0}, heading, along, words}; }

TEST(Places, NeighboursAreFoundByDistanceAndHeading) {
  const Place here = at(0, 3.1, 0, {});
  EXPECT_EQ(findNeighbour(here, at(4.9, 3.1, 0, {})), Neighbour::Same);
  EXPECT_EQ(findNeighbour(here, at(0, -3.1, 0, {})), Neighbour::Same);  // 5 deg across the seam of angles
  EXPECT_EQ(findNeighbour(here, at(7, 3.1, 0, {})), Neighbour::Near);
  EXPECT_EQ(findNeighbour(here, at(11, 3.1, 0, {})), Neighbour::Elsewhere);
  EXPECT_EQ(findNeighbour(here, at(0, 0.0, 0, {})), Neighbour::Elsewhere);
}

TEST(Places, AWordInEveryPictureIsWorthNothing) {
  const std::vector<double> worth = wordWeights({{3, 1, 0}, {1, 0, 0}});
  EXPECT_EQ(worth, (std::vector<double>{0.0, std::log(2.0), 0.0}));
  EXPECT_EQ(likeness({5, 0, 0}, {5, 0, 0}, worth), 0.0);
  EXPECT_TRUE(wordWeights({}).empty());
}

TEST(Places, SimilarityIsTheCosineOfInformativeWords) {
  const std::vector<double> worth = {1.0, 2.0};
  EXPECT_NEAR(likeness({1, 3}, {2, 6}, worth), 1.0, 1e-12);
  EXPECT_NEAR(likeness({1, 0}, {0, 1}, worth), 0.0, 1e-12);
  EXPECT_NEAR(likeness({2, 0}, {2, 1}, worth), std::sqrt(0.5), 1e-12);
}

TEST(Places, MistakesAreOfRevisitsAlone) {
  const Counts a = {4, 0, 1}, b = {0, 4, 1};
  const std::vector<double> worth = {1, 1, 1};
  // Back at 0 with the looks of 50: a mistake. At 50 again, looking as before: none.
  const std::vector<Place> motion = {at(0, 0, 0, a), at(50, 0, 50, b), at(0, 0, 100, b), at(50, 0, 150, b)};
  Recognition found = recognise(motion, worth, 25.0);
  EXPECT_EQ(found.revisits, 2);
  EXPECT_EQ(found.mistaken, 1);
  EXPECT_EQ(found.new_places, 1);  // the second; before the first there is nothing to be taken for
  EXPECT_EQ(found.taken_for_known, 0);
  found = recognise(motion, worth, 120.0);  // now the past of the last place is the first one alone
  EXPECT_EQ(found.revisits, 0);
  EXPECT_EQ(found.new_places, 1);
}

TEST(Places, NewPlacesLikeOldOnesAreTakenForThem) {
  const Counts a = {4, 0}, near_a = {4, 1}, b = {0, 4};
  const std::vector<Place> motion = {at(0, 0, 0, a), at(0, 0, 30, near_a), at(50, 0, 80, a), at(90, 0, 120, b)};
  const Recognition found = recognise(motion, {1, 1}, 25.0);
  EXPECT_EQ(found.revisits, 1);
  EXPECT_EQ(found.mistaken, 0);
  EXPECT_EQ(found.new_places, 2);
  EXPECT_EQ(found.taken_for_known, 1);
}

TEST(Places, TheNearestInAMapIsNotTheVerySameSpot) {
  const Counts a = {4, 0}, near_a = {4, 1}, b = {0, 4};
  const Place here = at(0.2, 0, 0, a);
  EXPECT_EQ(nearestIn({at(0, 0, 0, a), at(3, 0, 3, near_a), at(60, 0, 60, b)}, here, {1, 1}), Neighbour::Same);
  EXPECT_EQ(nearestIn({at(0, 0, 0, a), at(3, 0, 3, b), at(60, 0, 60, near_a)}, here, {1, 1}), Neighbour::Elsewhere);
  EXPECT_EQ(nearestIn({at(0, 0, 0, a), at(8, 0, 8, near_a)}, here, {1, 1}), Neighbour::Near);
}

TEST(Places, WordsLostAreCountedOnce) {
  EXPECT_DOUBLE_EQ(shareLost({9, 1, 0, 2}, {1, 0, 7, 0}), 2.0 / 3.0);
  EXPECT_EQ(shareLost({0, 0}, {1, 1}), 0.0);
}

}  // namespace
}  // namespace urban_nav_sim::bench
