// SPDX-License-Identifier: BSD-3-Clause
#include "topics/loops/cloud_units.hpp"

#include <gtest/gtest.h>

namespace urban_nav {
namespace {

using urban_nav_core::CloudFile;

/// A wall of 40 x 10 points, `spacing` apart, centred at `offset`.
CloudFile makeWall(float spacing, const Eigen::Vector3d& offset = Eigen::Vector3d::Zero()) {
  CloudFile file;
  file.offset = offset;
  for (int i = 0; i < 40; ++i)
    for (int j = 0; j < 10; ++j)
      file.cloud.points.emplace_back(spacing * static_cast<float>(i - 20), spacing * static_cast<float>(j - 5), 0.0F);
  return file;
}

bool holds(const std::string& text, const char* words) { return text.find(words) != std::string::npos; }

TEST(CloudUnits, AreNamedByTheSpacingOfPoints) {
  EXPECT_TRUE(holds(describeUnits(makeWall(10.0F), makeWall(12.0F)), "centimetres"));
  EXPECT_TRUE(holds(describeUnits(makeWall(120.0F), makeWall(150.0F)), "millimetres"));
  EXPECT_TRUE(holds(describeUnits(makeWall(0.1F), makeWall(10.0F)), "units differ"));
  EXPECT_EQ(describeUnits(makeWall(0.1F), makeWall(0.3F)), "");
}

TEST(CloudUnits, MiddlesFarApartAreNamedWithTheirDistance) {
  const CloudFile local = makeWall(0.1F), utm = makeWall(0.1F, {691244.0, 5334577.0, 519.0});
  EXPECT_TRUE(holds(describeUnits(local, utm), "5379.2 km")) << describeUnits(local, utm);
  EXPECT_EQ(describeUnits(local, makeWall(0.1F, {300.0, 0.0, 0.0})), "");
}

}  // namespace
}  // namespace urban_nav
