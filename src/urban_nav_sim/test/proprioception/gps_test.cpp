// SPDX-License-Identifier: BSD-3-Clause
#include "proprioception/gps.hpp"

#include <gtest/gtest.h>

#include "proprioception/test_motion.hpp"

namespace urban_nav_sim {
namespace {

using Eigen::Vector3d;
using urban_nav_core::Pose;

const Clock kGpsClock(0, ClockOptions{}, Noise(1, "clock"));
const Pose kPlace(Eigen::Quaterniond::Identity(), {-0.15, 0.0, 1.3});
const Schedule kGpsSchedule = sensorSchedule(Sensor::Gps);

Vector3d positionError(const Gps& gps, const Motion& motion, std::int64_t k) {
  const GpsMeasurement fix = gps.at(k);
  return toLocal(kOxford, {fix.latitude, fix.longitude, fix.altitude}) -
         motion.at(kGpsSchedule.at(k)).T_world_base * kPlace.t();
}

TEST(Geodesy, ComputesTheLengthsOfDegrees) {
  // 111 km a degree of latitude; of longitude at the equator 2 pi a / 360.
  EXPECT_NEAR(fromLocal({0, 0, 0}, {1.0, 0, 0}).longitude, 360.0 / (2.0 * M_PI * 6378137.0), 1e-12);
  EXPECT_NEAR(fromLocal({90, 0, 0}, {0, 0, 7.0}).altitude, 7.0, 1e-6);
  EXPECT_NEAR(fromLocal(kOxford, {0, 0, 25.0}).altitude, kOxford.altitude + 25.0, 1e-8);
  EXPECT_NEAR(fromLocal(kOxford, {0, 1000.0, 0}).latitude - kOxford.latitude, 1.0 / 111.26, 3e-5);
  EXPECT_NEAR(fromLocal(kOxford, {1000.0, 0, 0}).altitude, kOxford.altitude + 0.0783, 2e-3);  // the earth is round
}

TEST(Geodesy, BackAndForthIsTheSame) {
  for (const Vector3d& p : {Vector3d(0, 0, 0), Vector3d(300, -200, 12), Vector3d(-5000, 8000, 100)}) {
    EXPECT_LT((toLocal(kOxford, fromLocal(kOxford, p)) - p).norm(), 1e-6);
  }
}

TEST(Gps, WithoutErrorsItIsTheAntenna) {
  const auto motion = testMotion(60.0);
  const Gps gps(*motion, kPlace, perfectGps(), kGpsClock, Noise(7, "gps"));
  for (std::int64_t k = 0; k < 60; ++k) {
    EXPECT_TRUE(gps.at(k).has_fix);
    EXPECT_LT(positionError(gps, *motion, k).norm(), 1e-6);
    const double h = 1e-4, t = kGpsSchedule.at(k);
    const Vector3d velocity =
        (motion->at(t + h).T_world_base * kPlace.t() - motion->at(t - h).T_world_base * kPlace.t()) / (2 * h);
    EXPECT_LT((gps.at(k).velocity - velocity).norm(), 1e-4);
  }
}

TEST(Gps, ErrorsAreSlowAndOfTheSizeThatIsStated) {
  const auto motion = testMotion(900.0);
  double square = 0.0, stated = 0.0, step = 0.0;
  int fixes = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const Gps gps(*motion, kPlace, GpsOptions{}, kGpsClock, Noise(seed, "gps"));
    for (std::int64_t k = 1; k < 900; ++k) {
      if (!gps.at(k).has_fix || !gps.at(k - 1).has_fix) continue;
      ++fixes;
      const Vector3d off = positionError(gps, *motion, k);
      square += off.x() * off.x();
      stated += std::pow(gps.at(k).sigma.x(), 2);
      step += std::pow(off.x() - positionError(gps, *motion, k - 1).x(), 2);
    }
  }
  ASSERT_GT(fixes, 2000);
  const double rms = std::sqrt(square / fixes);
  EXPECT_GT(rms, 1.0);
  EXPECT_LT(rms, 10.0);
  EXPECT_GT(rms / std::sqrt(stated / fixes), 0.6);
  EXPECT_LT(rms / std::sqrt(stated / fixes), 2.5);
  EXPECT_LT(std::sqrt(step / fixes), 0.4 * rms);
}

TEST(Gps, GapsKeepTheLastPositionAndReportIt) {
  const auto motion = testMotion(300.0);
  int gaps = 0, all = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Gps gps(*motion, kPlace, GpsOptions{}, kGpsClock, Noise(seed, "gps"));
    for (std::int64_t k = 1; k < 300; ++k, ++all) {
      const GpsMeasurement now = gps.at(k), before = gps.at(k - 1);
      EXPECT_TRUE(std::isfinite(now.latitude) && std::isfinite(now.altitude) && std::abs(now.latitude - 51.75) < 0.1);
      if (now.has_fix) continue;
      ++gaps;
      EXPECT_EQ(now.longitude, before.longitude);
      EXPECT_GT(now.sigma.x(), 100.0);
    }
  }
  EXPECT_GT(gaps, 0);
  EXPECT_LT(gaps, all / 2);
}

}  // namespace
}  // namespace urban_nav_sim
