// SPDX-License-Identifier: BSD-3-Clause
#include "topics/lasers/lasers_report.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "topics/lasers/sensor_counts.hpp"

namespace urban_nav {
namespace {

std::string findValue(const Json& json, const std::string& key) {
  for (const auto& [name, text] : json.flat())
    if (name == key) return text;
  return "absent";
}

TEST(LasersReport, PointsAreCountedBySensorOverAllMaps) {
  LasersRun run;
  run.maps.resize(2);
  run.maps[0].points = 7;
  run.maps[0].points_by_sensor = {{"laser_left", 4}, {"stereo", 3}};
  run.maps[0].ghost_beams = 11;
  run.maps[1].points = 5;
  run.maps[1].points_by_sensor = {{"laser_left", 2}, {"points0", 3}};
  run.maps[1].ghost_beams = 2;
  const Json json = toJson(run);
  EXPECT_EQ(findValue(json, "points"), "12");
  EXPECT_EQ(findValue(json, "points_by_sensor.laser_left"), "6");
  EXPECT_EQ(findValue(json, "points_by_sensor.points0"), "3");
  EXPECT_EQ(findValue(json, "points_by_sensor.stereo"), "3");
  EXPECT_EQ(findValue(json, "movers_removed"), "13");
}

TEST(SensorCounts, AreNamedByRoleAndOtherPlanarLasersByFrame) {
  SensorCounts counts;
  for (const int sensor : {0, 0, 2, 3, 3, 3, 255}) counts.add(static_cast<std::uint8_t>(sensor));
  const std::map<std::string, std::size_t> expected = {
      {"base_laser", 1}, {"laser_left", 2}, {"laser_right", 0}, {"rear_laser", 3}, {"stereo", 1}};
  EXPECT_EQ(counts.byName({{0, "laser_left", "laser_left"},
                           {1, "laser_right", "laser_right"},
                           {2, "laser", "base_laser"},
                           {3, "laser", "rear_laser"},
                           {255, "stereo", "left"},
                           {255, "stereo", "other"}}),
            expected);
}

}  // namespace
}  // namespace urban_nav
