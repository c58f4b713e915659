// SPDX-License-Identifier: BSD-3-Clause
#include "error_model.hpp"

#include <gtest/gtest.h>

#include "urban_nav_core/testing/dice.hpp"

namespace laser_odometry {
namespace {

/// Cells two blocks apart, and their matches: residuals of a lasting and of a passing part (m, one sigma).
struct Surfaces {
  std::vector<MapCell> cells;
  std::vector<double> lasting;

  explicit Surfaces(double sigma) : cells(400), lasting(400) {
    urban_nav_core::testing::Dice dice(1);
    for (double& value : lasting) value = sigma * dice.normal();
  }

  std::vector<PatchMatch> measure(double sigma, std::uint64_t seed) {
    urban_nav_core::testing::Dice dice(seed);
    std::vector<PatchMatch> matches;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      PatchMatch match;
      match.cell = &cells[i];
      match.row.weight = 1e4;  // 1 cm
      match.residual = lasting[i] + sigma * dice.normal();
      match.p_odom = Vector3d(8.0 * static_cast<double>(i), 0, 0);
      matches.push_back(match);
    }
    return matches;
  }
};

TEST(ErrorModel, PassingErrorsDifferFromLastingOnes) {
  Surfaces passing(0.0), lasting(0.01);
  ErrorModel a, b;
  for (int i = 0; i < 30; ++i) {
    a.observe(passing.measure(0.02, static_cast<std::uint64_t>(10 + i)), i);
    b.observe(lasting.measure(0.0, static_cast<std::uint64_t>(10 + i)), i);
  }
  EXPECT_NEAR(a.passing(), 4.0, 0.8);  // (2 cm / 1 cm)^2
  EXPECT_LT(a.lasting(), 0.5);
  EXPECT_LT(b.passing(), 0.05);
  EXPECT_NEAR(b.lasting(), 1.0, 0.3);
}

TEST(ErrorModel, PatchesOfOneBlockThatErrTogetherAreOneMeasurement) {
  Surfaces surfaces(0.0);
  ErrorModel errors;
  for (int i = 0; i < 30; ++i) {
    std::vector<PatchMatch> matches = surfaces.measure(0.01, static_cast<std::uint64_t>(i));
    for (std::size_t j = 0; j < matches.size(); ++j) {
      matches[j].p_odom = Vector3d(8.0 * static_cast<double>(j / 10), 0, 0);
      matches[j].residual = matches[10 * (j / 10)].residual;
    }
    errors.observe(matches, i);
  }
  EXPECT_NEAR(errors.passing(), 10.0, 4.0);
}

TEST(ErrorModel, AgeIsThatOfTheSurfaces) {
  Surfaces surfaces(0.0);
  for (MapCell& cell : surfaces.cells) cell.first_sweep = 5;
  ErrorModel errors;
  errors.observe(surfaces.measure(0.01, 1), 25);
  EXPECT_DOUBLE_EQ(errors.age(), 20.0);
}

}  // namespace
}  // namespace laser_odometry
