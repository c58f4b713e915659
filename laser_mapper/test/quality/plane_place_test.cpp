// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/quality/plane_place.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "laser_mapper/quality/map_quality.hpp"

namespace laser_mapper {
namespace {

using Eigen::Vector3d;

constexpr double kVoxel = 0.05;
constexpr urban_nav_core::StampNs kFirstPass = 1'225'719'872'000'000'000;

/// Measurement of a wall near y = 3 m, x = 2...6, z = 0...3 in one pass: rotated about z by `turn` (rad) around x = 4,
/// displaced by `shift` (m), with noise of `sigma`; `from`, `to`: measured interval of x.
PassCells wallOfPass(std::uint16_t pass, double turn, double shift, double sigma, double from = 2.0, double to = 6.0) {
  std::mt19937 random(pass + 1U);
  std::normal_distribution<double> noise(0.0, 1.0);
  std::uniform_real_distribution<double> within(-0.02, 0.02);
  PassCells made;
  made.pass = pass;
  for (double x = from; x < to; x += kVoxel)
    for (double z = 0.02; z < 3.0; z += kVoxel) {
      const double along = x + within(random);
      const Vector3d p(along, 3.03 + shift + std::tan(turn) * (along - 4.0) + sigma * noise(random),
                       z + within(random));
      MergedCell cell;
      const Vector3d corner = (p / kVoxel).array().floor();
      cell.cell = {static_cast<int>(corner.x()), static_cast<int>(corner.y()), static_cast<int>(corner.z())};
      cell.offset = (p / kVoxel - corner).cast<float>();
      cell.to_laser = {0.0F, -1.0F, 0.0F};
      cell.count = 2.0F;
      cell.pass = pass;
      cell.stamp = kFirstPass + static_cast<urban_nav_core::StampNs>(pass) * 60'000'000'000;
      made.cells.push_back(cell);
    }
  return made;
}

std::vector<PlanePlace> placesBetween(const std::vector<PassCells>& passes) {
  return findPlanePlaces(kVoxel, 0.003, passes);
}

TEST(PlanePlace, AngleAndDisplacementAreThoseOfThePasses) {
  const double turn = 0.01;
  const auto places = placesBetween({wallOfPass(0, 0.0, 0.0, 0.003), wallOfPass(1, turn, 0.04, 0.003)});
  ASSERT_GT(places.size(), 8U);
  for (const PlanePlace& place : places) {
    ASSERT_EQ(place.pairs.size(), 1U);
    EXPECT_TRUE(place.isWall());
    EXPECT_NEAR(place.angle, turn, 4.0 * place.angle_sigma + 2e-4);
    EXPECT_NEAR(place.displacement, 0.04 + turn * (place.centre.x() - 4.0), 0.002);
    EXPECT_LT(place.angle_sigma, 0.002);
    EXPECT_GT(place.displacement_sigma, 0.003) << "two lasers may have different constant errors";
  }
}

TEST(PlanePlace, OneWallMeasuredInDifferentPartsIsNotDisplaced) {
  // Centroids lie up to 0.3 m apart along the wall.
  const auto places =
      placesBetween({wallOfPass(0, 0.1, 0.0, 0.003, 2.0, 4.6), wallOfPass(1, 0.1, 0.0, 0.003, 4.0, 6.0)});
  ASSERT_FALSE(places.empty());
  for (const PlanePlace& place : places) {
    EXPECT_LT(place.displacement, 0.002);
    EXPECT_LT(place.angle, 0.01);
  }
}

TEST(PlanePlace, AllPairsOfPassesCount) {
  const auto places = placesBetween({wallOfPass(0, 0.0, 0.0, 0.003), wallOfPass(1, 0.0, 0.03, 0.003),
                                     wallOfPass(2, 0.0, 0.06, 0.003), wallOfPass(3, 0.0, 0.09, 0.003)});
  ASSERT_FALSE(places.empty());
  for (const PlanePlace& place : places) {
    EXPECT_EQ(place.patches.size(), 4U);
    EXPECT_EQ(place.pairs.size(), 6U);
    EXPECT_NEAR(place.displacement, (3 * 0.03 + 2 * 0.06 + 0.09) / 6.0, 0.002);
  }
}

TEST(PlanePlace, PassesOfTheSameTimeHedgesAndBacksOfWallsGiveNoPlace) {
  PassCells soon = wallOfPass(1, 0.0, 0.0, 0.003);
  for (MergedCell& cell : soon.cells) cell.stamp = kFirstPass + 5'000'000'000;
  EXPECT_TRUE(placesBetween({wallOfPass(0, 0.0, 0.0, 0.003), soon}).empty());
  EXPECT_TRUE(placesBetween({wallOfPass(0, 0.0, 0.0, 0.08), wallOfPass(1, 0.0, 0.0, 0.08)}).empty());
  PassCells back = wallOfPass(1, 0.0, 0.2, 0.003);
  for (MergedCell& cell : back.cells) cell.to_laser = -cell.to_laser;
  EXPECT_TRUE(placesBetween({wallOfPass(0, 0.0, 0.0, 0.003), back}).empty());
  EXPECT_TRUE(placesBetween({wallOfPass(0, 0.0, 0.0, 0.003)}).empty());
  EXPECT_TRUE(placesBetween({}).empty());
}

TEST(MapQuality, FiguresAreThoseOfThePairsAndPlaces) {
  const MapQuality quality(
      placesBetween({wallOfPass(0, 0.0, 0.0, 0.002), wallOfPass(1, 0.0, 0.02, 0.002), wallOfPass(2, 0.0, 0.06, 0.002)}),
      kVoxel);
  const QualityFigures walls = quality.walls();
  EXPECT_EQ(walls.places, quality.places().size());
  EXPECT_EQ(walls.pairs, 3 * walls.places);
  EXPECT_NEAR(walls.displacement.mean, 0.04, 0.001);
  EXPECT_NEAR(walls.displacement.least, 0.02, 0.002);
  EXPECT_NEAR(walls.displacement.largest, 0.06, 0.002);
  EXPECT_NEAR(walls.displacement.least_mean, walls.displacement.largest_mean, 0.002);
  EXPECT_EQ(quality.ground().places, 0U);
  EXPECT_EQ(MapQuality().walls().displacement.mean, 0.0);
}

TEST(MapQuality, PointsOnAPlaceHaveItsDisplacementAndOthersNone) {
  const MapQuality quality(placesBetween({wallOfPass(0, 0.0, 0.0, 0.002), wallOfPass(1, 0.0, 0.02, 0.002)}), kVoxel);
  const auto displacement = quality.displacementAt({4.0F, 3.04F, 1.5F});
  ASSERT_TRUE(displacement);
  EXPECT_NEAR(*displacement, 0.02F, 0.002F);
  EXPECT_FALSE(quality.displacementAt({4.0F, 3.4F, 1.5F})) << "off the wall";
  EXPECT_FALSE(quality.displacementAt({40.0F, 3.04F, 1.5F}));
}

TEST(MapQuality, TheTableHasARowPerPlace) {
  const MapQuality quality(placesBetween({wallOfPass(0, 0.0, 0.0, 0.002), wallOfPass(1, 0.0, 0.02, 0.002)}), kVoxel);
  const std::string csv = quality.printCsv();
  EXPECT_EQ(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')), quality.places().size() + 1);
  const std::size_t columns =
      static_cast<std::size_t>(std::count(csv.begin(), csv.begin() + static_cast<std::ptrdiff_t>(csv.find('\n')), ','));
  EXPECT_EQ(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), ',')), columns * (quality.places().size() + 1));
  EXPECT_NE(csv.find(",wall,2,1,"), std::string::npos);
}

}  // namespace
}  // namespace laser_mapper
