// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <opencv2/core.hpp>

#include "urban_nav_sim/session.hpp"

namespace urban_nav_sim {
namespace {

constexpr double kKnockAt = 0.5;   // s; the robot does not move for the first 1.5 s
constexpr double kBeamStep = 0.5;  // deg

/// Scans of a session by side and true time, s.
using Scans = std::map<std::pair<Side, double>, urban_nav_core::PlanarScan>;

class Knock : public ::testing::Test {
 protected:
  /// Runs a second of a session without noise.
  static void run(const std::string& fault, Sensor sensor, Scans* scans, std::map<double, cv::Mat>* images) {
    SessionOptions options;
    options.duration = 1.0;
    options.sensors = {sensor};
    options.defects.switchOff("all:all");
    if (!fault.empty()) options.faults = {parseFault(fault)};
    Session session(options);
    while (const auto arrival = session.next()) {
      const double t = 1e-9 * static_cast<double>(arrival->taken - session.begin());
      if (const auto* laser = std::get_if<LaserMeasurement>(&arrival->measurement))
        (*scans)[{laser->side, t}] = laser->scan;
      if (const auto* image = std::get_if<LadybugMeasurement>(&arrival->measurement); image && image->camera == 0)
        (*images)[t] = image->image;
    }
  }
};

TEST_F(Knock, OfTheLasersTurnsTheLeftOneByOneBeam) {
  Scans sound, knocked;
  run("", Sensor::Lasers, &sound, nullptr);
  run("knock:lasers:0.5:0:" + std::to_string(kBeamStep), Sensor::Lasers, &knocked, nullptr);
  ASSERT_EQ(sound.size(), knocked.size());
  std::size_t turned = 0, near = 0, beams = 0;
  for (const auto& [key, scan] : sound) {
    const urban_nav_core::PlanarScan& other = knocked.at(key);
    if (key.first == Side::Right || key.second < kKnockAt) {
      EXPECT_EQ(scan.ranges, other.ranges) << key.second;
      continue;
    }
    ++turned;
    for (std::size_t i = 0; i + 1 < scan.ranges.size(); ++i) {
      if (!std::isfinite(scan.ranges[i + 1]) || !std::isfinite(other.ranges[i])) continue;
      ++beams;
      near += std::abs(other.ranges[i] - scan.ranges[i + 1]) < 1e-3 ? 1 : 0;
    }
  }
  EXPECT_GT(turned, 10U);
  EXPECT_GT(beams, 1000U);
  EXPECT_GT(near, beams * 98 / 100) << "a beam measures what the next one measured before; people may walk past";
}

TEST_F(Knock, OfTheLadybugTurnsItsHeadFromThenOn) {
  std::map<double, cv::Mat> sound, knocked;
  run("", Sensor::Ladybug, nullptr, &sound);
  run("knock:ladybug:0.5:0:3", Sensor::Ladybug, nullptr, &knocked);
  ASSERT_EQ(sound.size(), knocked.size());
  std::size_t before = 0, after = 0;
  for (const auto& [t, image] : sound) {
    const double difference = cv::norm(image, knocked.at(t), cv::NORM_L1) / static_cast<double>(image.total());
    if (t < kKnockAt) {
      EXPECT_EQ(difference, 0.0) << t;
      ++before;
    } else {
      EXPECT_GT(difference, 1.0) << t;
      ++after;
    }
  }
  EXPECT_GT(before, 0U);
  EXPECT_GT(after, 0U);
}

}  // namespace
}  // namespace urban_nav_sim
