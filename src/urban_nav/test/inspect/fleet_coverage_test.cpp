// SPDX-License-Identifier: BSD-3-Clause
#include "inspect/fleet_coverage.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace urban_nav {
namespace {

/// A straight drive along x.
FleetSession straightDrive(const std::string& robot, const std::string& day, double from, double to) {
  FleetSession session;
  session.session.robot = robot;
  session.store = "fleet.db";
  session.map = "abc";
  session.day = day;
  for (double x = from; x <= to; x += 1.0) session.path.emplace_back(x, 0.0);
  return session;
}

TEST(FleetCoverage, CountsAreasOnceAndKnowsWhichWereSeenAgain) {
  Fleet fleet;
  fleet.sessions = {straightDrive("a", "2026-05-01", 0.0, 100.0), straightDrive("b", "2026-05-01", 0.0, 100.0),
                    straightDrive("a", "2026-05-02", 50.0, 200.0)};
  const std::vector<MapCoverage> all = computeCoverage(fleet);
  ASSERT_EQ(all.size(), 1U);
  const MapCoverage& coverage = all.front();
  EXPECT_EQ(coverage.sessions, 3U);
  EXPECT_EQ(coverage.days, 2U);
  EXPECT_EQ(coverage.last_day, "2026-05-02");
  const double ends = M_PI * 25.0;  // half a disc at both ends
  EXPECT_NEAR(coverage.area_m2, 200.0 * 10.0 + ends, 0.05 * 2000.0);
  EXPECT_NEAR(coverage.repeated_m2, 50.0 * 10.0 + ends, 0.1 * 500.0);
  EXPECT_NEAR(coverage.newest_m2, 100.0 * 10.0, 0.1 * 1000.0);
  EXPECT_LE(coverage.repeated_m2 + coverage.newest_m2, coverage.area_m2);
}

TEST(FleetCoverage, MapsAreApartAndTheLargestIsFirst) {
  Fleet fleet;
  fleet.sessions = {straightDrive("a", "2026-05-01", 0.0, 10.0), straightDrive("a", "2026-05-01", 0.0, 90.0)};
  fleet.sessions[1].map = "def";
  const std::vector<MapCoverage> all = computeCoverage(fleet);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].map, "def");
  EXPECT_EQ(all[0].repeated_m2, 0.0);
  EXPECT_EQ(all[0].newest_m2, all[0].area_m2);
  const Section section = coverageSection(fleet);
  EXPECT_EQ(section.figures.size(), 2U);
  EXPECT_EQ(section.tables.front().rows.size(), 2U);
}

}  // namespace
}  // namespace urban_nav
