// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/retrieval/similar_places.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "urban_nav_core/testing/scanner.hpp"

namespace urban_nav_registration {
namespace {

using urban_nav_core::PointCloud;
using urban_nav_core::testing::courtyard;

constexpr double kPlaceVoxel = 0.5;  // m

/// Surroundings in a courtyard of its own, seen from a position (m) with a heading (deg).
PlaceDescription placeIn(std::uint64_t seed, double x = 0.0, double y = 0.0, double heading = 0.0) {
  PointCloud cloud =
      urban_nav_core::testing::scan(courtyard(seed), urban_nav_core::testing::stand(x, y, heading), {}, seed + 7);
  for (Eigen::Vector3f& p : cloud.points) p.z() += 1.5F;  // base_link is on the ground
  return describePlace(cloud, kPlaceVoxel).value();
}

TEST(SimilarPlaces, AreEarlierOnesFarAlongThePathAtAnyHeading) {
  SimilarPlaceFinder finder;
  for (std::size_t i = 0; i < 8; ++i) finder.add({placeIn(100 + i), 0, 10.0 * static_cast<double>(i), false});
  const std::vector<SimilarPlaces> back = finder.add({placeIn(102, 0.5, 0.5, 120.0), 0, 80.0, false});
  ASSERT_FALSE(back.empty());
  EXPECT_EQ(back.front().earlier, 2U);
  EXPECT_EQ(back.front().later, 8U);
  EXPECT_GT(back.front().similarity, 0.5);
  EXPECT_LE(back.front().similarity, 1.0);
  for (const SimilarPlaces& near : finder.add({placeIn(102, 0.5, 0.0, 0.0), 0, 85.0, false}))
    EXPECT_NE(near.earlier, 8U) << "five metres before";
  const std::vector<SimilarPlaces> other_session = finder.add({placeIn(103, 0.0, 0.5, 170.0), 1, 0.0, false});
  ASSERT_FALSE(other_session.empty());
  EXPECT_EQ(other_session.front().earlier, 3U);
  EXPECT_TRUE(finder.add({placeIn(104, 0.0, 0.5, 170.0), 1, 10.0, true}).empty()) << "known";
}

TEST(SimilarPlaces, TwoPlacesThatLookAlikeAreBothProposed) {
  SimilarPlaceFinder finder;
  finder.add({placeIn(5), 0, 0.0, false});
  finder.add({placeIn(5, 0.1, 0.0, 90.0), 1, 0.0, true});
  const std::vector<SimilarPlaces> similar = finder.add({placeIn(5, 0.0, 0.3, 45.0), 2, 0.0, false});
  ASSERT_EQ(similar.size(), 2U);
  EXPECT_EQ(similar[0].earlier + similar[1].earlier, 1U);
}

TEST(SimilarPlaces, ACloudThatShowsTooLittleIsNoPlace) { EXPECT_FALSE(describePlace({}, kPlaceVoxel)); }

}  // namespace
}  // namespace urban_nav_registration
