// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/retrieval/cloud_descriptor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "urban_nav_core/testing/dice.hpp"

namespace urban_nav_registration {
namespace {

using urban_nav_core::PointCloud;
using urban_nav_core::testing::Dice;

/// Houses of random size around a place, on the ground; from a position (m) near the origin and with a heading (rad).
PointCloud surroundings(std::uint64_t seed, double x, double y, double heading) {
  Dice houses(seed), noise(seed + 17);
  PointCloud cloud;
  const auto add = [&](double px, double py, double pz) {
    const double dx = px - x, dy = py - y, c = std::cos(heading), s = std::sin(heading);
    cloud.points.emplace_back(static_cast<float>(c * dx + s * dy), static_cast<float>(c * dy - s * dx),
                              static_cast<float>(pz + 0.02 * noise.normal()));
  };
  for (int house = 0; house < 15; ++house) {
    const double angle = houses.uniform(0.0, 2.0 * M_PI), distance = houses.uniform(6.0, 30.0),
                 height = houses.uniform(2.0, 9.0), width = houses.uniform(3.0, 10.0);
    for (int i = 0; i < 400; ++i) {
      const double along = noise.uniform(-0.5, 0.5) * width;
      add(distance * std::cos(angle) - along * std::sin(angle), distance * std::sin(angle) + along * std::cos(angle),
          noise.uniform(0.0, height));
    }
  }
  for (int i = 0; i < 4000; ++i) add(noise.uniform(-30.0, 30.0), noise.uniform(-30.0, 30.0), 0.0);
  return cloud;
}

CloudDescriptor describeFrom(std::uint64_t seed, double x = 0.0, double y = 0.0, double heading = 0.0) {
  return CloudDescriptor::describe(surroundings(seed, x, y, heading)).value();
}

TEST(CloudDescriptor, TheSamePlaceIsMoreSimilarThanOthersAtAnyHeading) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const CloudDescriptor place = describeFrom(seed);
    double other = 0.0;
    for (std::uint64_t k = 10; k < 20; ++k) other = std::max(other, place.similarity(describeFrom(k)));
    for (const double heading : {0.0, 1.0, M_PI, -2.0}) {
      const double same = place.similarity(describeFrom(seed, 1.0, -1.0, heading));
      EXPECT_GT(same, other) << heading;
      EXPECT_LE(same, 1.0 + 1e-6);
    }
    EXPECT_NEAR(place.similarity(place), 1.0, 1e-5);
  }
}

TEST(CloudDescriptor, TooLittleIsNotDescribed) {
  EXPECT_FALSE(CloudDescriptor::describe({}));
  PointCloud cloud;
  cloud.points.emplace_back(std::numeric_limits<float>::quiet_NaN(), 1.0F, 1.0F);
  cloud.points.emplace_back(500.0F, 0.0F, 1.0F);
  cloud.points.emplace_back(5.0F, 0.0F, 1.0F);
  EXPECT_FALSE(CloudDescriptor::describe(cloud));
}

}  // namespace
}  // namespace urban_nav_registration
