// SPDX-License-Identifier: BSD-3-Clause
#include "topics/fusion/fused_session.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "map/odometry_summary.hpp"
#include "map/store_keys.hpp"
#include "topics/fusion/fusion_report.hpp"

namespace urban_nav {
namespace {

using urban_nav_core::Health;
using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;
using urban_nav_core::StepSource;
using urban_nav_core::Vector3d;
using urban_nav_core::Vector6d;

constexpr urban_nav_core::StampNs kFramePeriod = 100'000'000;

Pose makeMotion(int frame) {
  return Pose(urban_nav_core::expSo3(Vector3d(0.0, 0.0, 0.02 * std::sin(0.1 * frame))), Vector3d(0.5, 0.0, 0.0));
}

/// A drive whose lengths are `scale` times the true ones.
SessionOdometry makeDrive(OdometrySource source, int frames, double scale, double sigma) {
  SessionOdometry run;
  run.input = "drive";
  run.source = source;
  Pose pose(urban_nav_core::expSo3(Vector3d(0.1, 0.0, 0.0)), Vector3d(0.0, 0.0, 0.0));  // level: not the identity
  for (int i = 0; i < frames; ++i) {
    SmoothedFrame frame;
    frame.frame = i;
    frame.stamp = i * kFramePeriod;
    if (i > 0) {
      const Pose step(makeMotion(i).q(), scale * makeMotion(i).t());
      pose = pose * step;
      frame.from_previous.from = (i - 1) * kFramePeriod;
      frame.from_previous.to = i * kFramePeriod;
      frame.from_previous.T_from_to = step;
      frame.from_previous.covariance = sigma * sigma * Matrix6d::Identity();
      frame.from_previous.drift_covariance = 0.1 * frame.from_previous.covariance;
      if (source == OdometrySource::Stereo) {
        Vector6d along = Vector6d::Zero();
        along.head<3>() = step.t();
        frame.from_previous.constants.push_back({"scale", 0.0, 0.0, 5e-4, along});
      }
    }
    frame.T_odom_base.pose = pose;
    run.settled.push_back(frame);
    run.frames.push_back({i, frame.stamp, true, {}, pose, {}});
  }
  return run;
}

TEST(FusedSession, KeepsTheFirstPoseAndCorrectsTheScale) {
  const SessionOdometry stereo = makeDrive(OdometrySource::Stereo, 200, 0.99, 2e-3);
  const SessionOdometry laser = makeDrive(OdometrySource::Laser, 200, 1.0, 1e-3);
  const SessionOdometry fused = fuseSession(stereo, laser);
  ASSERT_TRUE(fused.fusion);
  EXPECT_EQ(fused.source, OdometrySource::Both);
  EXPECT_TRUE(isApprox(fused.settled.front().T_odom_base.pose, stereo.settled.front().T_odom_base.pose, 1e-12));
  EXPECT_NEAR(findConstant(*fused.fusion, "scale")->value, 1.0 / 0.99 - 1.0, 1e-3);
  EXPECT_LT(distanceBetween(fused.settled.back().T_odom_base.pose, laser.settled.back().T_odom_base.pose), 0.05);
  EXPECT_TRUE(isApprox(fused.frames.back().T_odom_base, fused.settled.back().T_odom_base.pose, 1e-12));
  EXPECT_TRUE(conflictSentences(fused).empty());
  const std::vector<std::string> notes = constantSentences(fused);
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_NE(notes.front().find("baseline"), std::string::npos) << notes.front();
}

TEST(FusedSession, ThePathIsAsUncertainAsItsStepsAndTheirCommonScale) {
  const SessionOdometry fused =
      fuseSession(makeDrive(OdometrySource::Stereo, 200, 1.0, 2e-3), makeDrive(OdometrySource::Laser, 200, 1.0, 1e-3));
  const Matrix6d& covariance = fused.settled.back().T_odom_base.covariance;
  EXPECT_TRUE(covariance.allFinite());
  double previous = 0.0;
  for (std::size_t i = 10; i < fused.settled.size(); i += 10) {
    const double sigma = std::sqrt(fused.settled[i].T_odom_base.covariance.topLeftCorner<3, 3>().trace());
    EXPECT_GT(sigma, previous);
    previous = sigma;
  }
  const urban_nav_core::SharedConstant* scale = findConstant(*fused.fusion, "scale");
  const double length = (fused.settled.back().T_odom_base.pose.t() - fused.settled.front().T_odom_base.pose.t()).norm();
  EXPECT_GT(std::sqrt(covariance.topLeftCorner<3, 3>().trace()), 0.3 * scale->sigma * length);
}

TEST(FusedSession, StepsAreCountedBySource) {
  SessionOdometry stereo = makeDrive(OdometrySource::Stereo, 50, 1.0, 2e-3);
  SessionOdometry laser = makeDrive(OdometrySource::Laser, 50, 1.0, 1e-3);
  for (std::size_t i = 10; i < 20; ++i) stereo.settled[i].from_previous.status.health = Health::Lost;
  for (std::size_t i = 15; i < 30; ++i) laser.settled[i].from_previous.status.health = Health::Lost;
  StepCounts counts;
  addSteps(fuseSession(stereo, laser), counts);
  EXPECT_EQ(counts.laser, 5);
  EXPECT_EQ(counts.none, 5);
  EXPECT_EQ(counts.stereo, 10);
  EXPECT_EQ(counts.both, 29);
}

TEST(FusedSession, ContradictionsAreNamedWithTheirTime) {
  const SessionOdometry stereo = makeDrive(OdometrySource::Stereo, 100, 1.0, 2e-3);
  SessionOdometry laser = makeDrive(OdometrySource::Laser, 100, 1.0, 1e-3);
  for (std::size_t i = 51; i < 56; ++i)
    laser.settled[i].from_previous.T_from_to = Pose(urban_nav_core::Quaterniond::Identity(), Vector3d(0.4, 0.0, 0.0));
  const SessionOdometry fused = fuseSession(stereo, laser);
  const std::vector<std::string> sentences = conflictSentences(fused);
  ASSERT_EQ(sentences.size(), 1U);
  EXPECT_NE(sentences.front().find("between 5 and 6 s"), std::string::npos) << sentences.front();
  EXPECT_EQ(fusionVerdicts(fused).front().grade, Grade::Bad);
  EXPECT_FALSE(fusionSection(fused).tables.empty());
}

TEST(FusedSession, NoVerdictIsGoodWhereTheCovariancesAreTooSmall) {
  SessionOdometry fused =
      fuseSession(makeDrive(OdometrySource::Stereo, 100, 1.0, 2e-3), makeDrive(OdometrySource::Laser, 100, 1.0, 1e-3));
  EXPECT_EQ(fusionVerdicts(fused).front().grade, Grade::Good);
  fused.fusion->spread = 8.0;
  const Verdict verdict = fusionVerdicts(fused).front();
  EXPECT_EQ(verdict.grade, Grade::Fair);
  EXPECT_NE(verdict.sentence.find("2.83 times"), std::string::npos) << verdict.sentence;
}

}  // namespace
}  // namespace urban_nav
