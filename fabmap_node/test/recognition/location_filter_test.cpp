// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/recognition/location_filter.hpp"

#include <gtest/gtest.h>

namespace fabmap_node {
namespace {

/// Filter after observations that each show one place of session 0.
LocationFilter filterAfter(const std::vector<std::size_t>& places, double log_ratio) {
  LocationFilter filter;
  for (const std::size_t place : places) filter.update({{0, place, log_ratio}});
  return filter;
}

TEST(LocationFilter, IsUniformBeforeTheFirstObservation) {
  const LocationFilter filter;
  EXPECT_EQ(filter.priorLogOdds(0, 5), 0.0);
  EXPECT_EQ(filter.motionConsistency(0, 5), 0.0);
  EXPECT_EQ(filter.probabilityNew(), 0.5);
}

TEST(LocationFilter, FavoursPlacesAroundTheLastOneInBothDirections) {
  const LocationFilter filter = filterAfter({20, 21, 22}, 2.0);
  EXPECT_GT(filter.priorLogOdds(0, 24), 1.0);
  EXPECT_DOUBLE_EQ(filter.priorLogOdds(0, 24), filter.priorLogOdds(0, 20));
  EXPECT_GT(filter.priorLogOdds(0, 24), filter.priorLogOdds(0, 60) + 1.0);
  EXPECT_DOUBLE_EQ(filter.priorLogOdds(0, 60), filter.priorLogOdds(1, 24));
}

TEST(LocationFilter, NewPlacesMakeKnownOnesLessLikely) {
  const LocationFilter filter = filterAfter({20, 50, 80, 10}, -5.0);
  EXPECT_GT(filter.probabilityNew(), 0.9);
  EXPECT_LT(filter.priorLogOdds(0, 90), -1.0);
}

TEST(LocationFilter, ProbabilitiesStayWithinTheirLimits) {
  LocationFilter filter;
  for (int i = 0; i < 200; ++i) {
    filter.update({{0, 7, 1e6}, {0, 8, 1e6}, {1, 7, -1e6}});
    EXPECT_GT(filter.probabilityNew(), 0.0);
    EXPECT_LT(filter.probabilityNew(), 1.0);
    EXPECT_LT(filter.priorLogOdds(0, 7), 6.0);
  }
}

TEST(LocationFilter, OnePathDrivenAgainIsConsistentInEitherDirection) {
  EXPECT_EQ(filterAfter({10, 11, 12, 13, 14, 15, 16, 17, 18, 19}, 0.0).motionConsistency(0, 20), 1.0);
  EXPECT_EQ(filterAfter({39, 37, 35, 33, 31, 29, 27, 25, 23, 21}, 0.0).motionConsistency(0, 19), 1.0);
  EXPECT_EQ(filterAfter({10, 11, 12, 13, 14}, 0.0).motionConsistency(0, 15), 0.5);
  EXPECT_EQ(filterAfter({10, 11, 12, 13, 14, 15}, 0.0).motionConsistency(1, 16), 0.0);
}

TEST(LocationFilter, PlacesThatStayOrJumpAreNot) {
  EXPECT_LT(filterAfter(std::vector<std::size_t>(10, 44), 0.0).motionConsistency(0, 44), 0.4);
  EXPECT_LT(filterAfter({3, 90, 17, 55, 130, 8, 71, 29, 102, 46}, 0.0).motionConsistency(0, 60), 0.4);
}

TEST(LikeliestLocation, PriorDecidesBetweenSimilarPlaces) {
  const LocationFilter filter = filterAfter({20, 21, 22}, 2.0);
  EXPECT_EQ(likeliestLocation(filter, {{0, 80, 0.1}, {0, 23, 0.0}}), 1u);
  EXPECT_EQ(likeliestLocation(filter, {{0, 80, 9.0}, {0, 23, 0.0}}), 0u);
  EXPECT_EQ(likeliestLocation(LocationFilter(), {{0, 80, 0.1}, {0, 23, 0.0}}), 0u);
}

}  // namespace
}  // namespace fabmap_node
