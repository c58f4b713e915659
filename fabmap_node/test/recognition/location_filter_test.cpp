// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/recognition/location_filter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

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
  EXPECT_EQ(filter.pathMargin(0, 5), 0.0);
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

/// Filter after observations that each show one place of session 0 with this margin.
LocationFilter filterWithMargin(const std::vector<std::size_t>& places, double margin) {
  LocationFilter filter;
  for (const std::size_t place : places) filter.update({{0, place, 0.0, margin}});
  return filter;
}

/// Twenty places from `first` on, `step` apart.
std::vector<std::size_t> twentyPlaces(std::size_t first, double step) {
  std::vector<std::size_t> places;
  for (int k = 0; k < 20; ++k)
    places.push_back(static_cast<std::size_t>(std::lround(static_cast<double>(first) + step * k)));
  return places;
}

TEST(LocationFilter, OnePathDrivenAgainHasTheMarginsOfItsPlacesInEitherDirection) {
  EXPECT_NEAR(filterWithMargin(twentyPlaces(10, 1.0), 0.25).pathMargin(0, 30), 0.25, 1e-12);
  EXPECT_NEAR(filterWithMargin(twentyPlaces(60, -2.0), 0.25).pathMargin(0, 20), 0.25, 1e-12);
  EXPECT_NEAR(filterWithMargin(twentyPlaces(10, 0.7), 0.25).pathMargin(0, 24), 0.25, 1e-12);
  EXPECT_NEAR(filterWithMargin({10, 11, 12, 13, 14}, 0.24).pathMargin(0, 15), 0.06, 1e-12);
  EXPECT_EQ(filterWithMargin({10, 11, 12, 13, 14, 15}, 0.25).pathMargin(1, 16), 0.0);
}

TEST(LocationFilter, PlacesThatStayOrJumpAreNotOnAPath) {
  EXPECT_LT(filterWithMargin(std::vector<std::size_t>(20, 44), 0.25).pathMargin(0, 44), 0.05);
  EXPECT_LT(filterWithMargin({3, 90, 17, 55, 130, 8, 71, 29, 102, 46}, 0.25).pathMargin(0, 60), 0.05);
}

TEST(LocationFilter, APathThroughPlacesThatResembleOthersHasNoMargin) {
  EXPECT_EQ(filterWithMargin(twentyPlaces(10, 1.0), -0.1).pathMargin(0, 30), 0.0);
  LocationFilter filter;  // the place on the path is not the first hypothesis
  for (std::size_t k = 0; k < 20; ++k) filter.update({{0, 200 - 7 * k, 1.0, 0.125}, {0, 10 + k, 0.0, 0.5}});
  EXPECT_NEAR(filter.pathMargin(0, 30), 0.5, 1e-12);
}

TEST(LikeliestLocation, PriorDecidesBetweenSimilarPlaces) {
  const LocationFilter filter = filterAfter({20, 21, 22}, 2.0);
  EXPECT_EQ(likeliestLocation(filter, {{0, 80, 0.1}, {0, 23, 0.0}}), 1u);
  EXPECT_EQ(likeliestLocation(filter, {{0, 80, 9.0}, {0, 23, 0.0}}), 0u);
  EXPECT_EQ(likeliestLocation(LocationFilter(), {{0, 80, 0.1}, {0, 23, 0.0}}), 0u);
}

}  // namespace
}  // namespace fabmap_node
