// SPDX-License-Identifier: BSD-3-Clause
// Errors and covariances of drives through places that leave directions free for a time (exact true poses).
#include "support/free_places.hpp"

#include <gtest/gtest.h>

namespace laser_odometry {
namespace {

using urban_nav_core::Health;

constexpr std::size_t kSpans[] = {1, 10, 50};

/// Checks the mean normalised squared errors. Free coordinates are stated with too large variances within a gap and
/// count little there: at least half of the `measured` ones, and at most 1.5 times all of them, are expected.
void expectHonest(const FreePlace& place, int measured) {
  constexpr std::uint64_t kSeeds = 2;
  const double least = 0.5 * measured, most = place.scanner == Scanner::Planar ? 4.5 : 9.0;
  double sums[] = {0.0, 0.0, 0.0}, end = 0.0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const FreeRun run = driveFreePlace(place, {}, seed);
    EXPECT_GT(run.free(), 20) << place.name;
    EXPECT_TRUE(run.poses.back().free_directions.empty()) << place.name;
    for (const LaserPose& pose : run.poses) ASSERT_NE(pose.status.health, Health::Lost) << pose.status;
    for (std::size_t i = 0; i < std::size(kSpans); ++i) sums[i] += run.nees(kSpans[i]) / kSeeds;
    const double error = run.error(run.poses.size() - 1);
    end += error * error / (run.stated() * run.stated()) / kSeeds;
  }
  for (std::size_t i = 0; i < std::size(kSpans); ++i) {
    EXPECT_GT(sums[i], least) << place.name << " " << kSpans[i];
    EXPECT_LT(sums[i], most) << place.name << " " << kSpans[i];
  }
  EXPECT_LT(end, 4.0) << place.name;  // mean square of both ends, in units of the stated variances
}

TEST(FreePlaces, ErrorsInACorridorAgreeWithTheirCovariances) { expectHonest(makeFreePlaces()[1], 2); }

TEST(FreePlaces, ErrorsInATunnelAgreeWithTheirCovariances) { expectHonest(makeFreePlaces()[2], 5); }

TEST(FreePlaces, ErrorsInAFieldAgreeWithTheirCovariances) { expectHonest(makeFreePlaces()[3], 3); }

}  // namespace
}  // namespace laser_odometry
