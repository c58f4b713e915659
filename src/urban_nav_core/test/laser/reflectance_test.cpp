// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/laser/reflectance.hpp"

#include <gtest/gtest.h>

namespace urban_nav_core {
namespace {

TEST(Reflectance, GrowsWhereOpticsDistanceAndIncidenceTookLight) {
  const float square_on = normaliseReflectance(60.0F, 5.0F, 1.0F);
  EXPECT_GT(normaliseReflectance(60.0F, 1.0F, 1.0F), square_on);
  EXPECT_GT(normaliseReflectance(60.0F, 16.0F, 1.0F), square_on);
  EXPECT_GT(normaliseReflectance(60.0F, 5.0F, 0.5F), square_on);
  EXPECT_EQ(normaliseReflectance(0.0F, 5.0F, 1.0F), 0.0F);
}

TEST(Reflectance, StaysWithinTheScaleOfTheDevice) {
  for (const float range : {0.0F, 0.01F, 80.0F, 1e6F})
    for (const float cosine : {-1.0F, 0.0F, 1.0F}) {
      const float value = normaliseReflectance(255.0F, range, cosine);
      EXPECT_TRUE(value >= 0.0F && value <= 255.0F) << range << " m, " << cosine;
    }
}

}  // namespace
}  // namespace urban_nav_core
