// SPDX-License-Identifier: BSD-3-Clause
#include "faults/fault_filter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

namespace urban_nav_sim {
namespace {

constexpr urban_nav_core::StampNs kBegin = 1'000'000'000'000;

urban_nav_core::StampNs at(double t) { return kBegin + std::llround(1e9 * t); }

StereoMeasurement pairAt(double t) {
  const int grey = static_cast<int>(10.0 * t);
  return {at(t), cv::Mat(8, 8, CV_8UC1, cv::Scalar(grey)), cv::Mat(8, 8, CV_8UC1, cv::Scalar(grey + 100))};
}

ImuMeasurement imuAt(double t) {
  ImuMeasurement imu;
  imu.stamp = at(t);
  return imu;
}

GpsMeasurement gpsAt(double t) {
  GpsMeasurement gps;
  gps.stamp = at(t);
  return gps;
}

int grey(const cv::Mat& image) { return image.at<std::uint8_t>(0, 0); }

std::optional<Measurement> applied(FaultFilter& filter, const Measurement& measurement) {
  return filter.apply(measurement, toStamp(measurement));
}

FaultFilter makeFilter(const std::string& fault) { return {{parseFault(fault)}, 7, kBegin}; }

TEST(FaultFilter, LeavesOtherTimesAndSensorsAlone) {
  FaultFilter filter = makeFilter("unplug:stereo:1:1");
  for (const double t : {0.0, 0.5, 1.0, 1.9, 2.0}) {
    const bool lost = t >= 1.0 && t < 2.0;
    EXPECT_EQ(applied(filter, pairAt(t)).has_value(), !lost) << t;
    EXPECT_TRUE(applied(filter, imuAt(t)));
    EXPECT_TRUE(applied(filter, TruthMeasurement{at(t), {}}));
    EXPECT_TRUE(applied(filter, ViewTruth{at(t), "stereo_left_optical_frame", {}, {}}));
  }
}

TEST(FaultFilter, GoesByTheTrueTimeNotByTheStamp) {
  FaultFilter filter = makeFilter("unplug:imu:1:1");
  EXPECT_TRUE(filter.apply(imuAt(1.3), at(0.9)));
  EXPECT_FALSE(filter.apply(imuAt(2.3), at(1.9)));
}

TEST(FaultFilter, FreezesWithNewStamps) {
  FaultFilter filter = makeFilter("freeze:stereo:1:1");
  applied(filter, pairAt(0.9));
  const auto frozen = std::get<StereoMeasurement>(*applied(filter, pairAt(1.5)));
  EXPECT_EQ(frozen.stamp, at(1.5));
  EXPECT_EQ(grey(frozen.left), 9);
  EXPECT_EQ(grey(std::get<StereoMeasurement>(*applied(filter, pairAt(2.5))).left), 25);
}

TEST(FaultFilter, FreezesTheFirstWhereThereIsNoneBefore) {
  FaultFilter filter = makeFilter("freeze:stereo:0:1");
  EXPECT_EQ(grey(std::get<StereoMeasurement>(*applied(filter, pairAt(0.2))).left), 2);
  const auto frozen = std::get<StereoMeasurement>(*applied(filter, pairAt(0.7)));
  EXPECT_EQ(frozen.stamp, at(0.7));
  EXPECT_EQ(grey(frozen.left), 2);
}

TEST(FaultFilter, SwapsSides) {
  FaultFilter filter = makeFilter("swap:stereo:0:9");
  EXPECT_EQ(grey(std::get<StereoMeasurement>(*applied(filter, pairAt(1.0))).left), 110);
  FaultFilter lasers = makeFilter("swap:lasers:0:9");
  LaserMeasurement turn;
  turn.scan.stamp = at(1.0);
  EXPECT_EQ(std::get<LaserMeasurement>(*applied(lasers, turn)).side, Side::Right);
}

TEST(FaultFilter, DropsTheShare) {
  FaultFilter filter = makeFilter("drop:imu:0:100:0.25");
  int arrived = 0;
  for (int i = 0; i < 4000; ++i) arrived += applied(filter, imuAt(0.01 * i)) ? 1 : 0;
  EXPECT_NEAR(arrived, 3000, 100);
}

TEST(FaultFilter, CorruptsACopyAndStaysFinite) {
  FaultFilter filter = makeFilter("corrupt:stereo:0:9:1");
  const StereoMeasurement sent = pairAt(1.0);
  const auto arrived = std::get<StereoMeasurement>(*applied(filter, sent));
  EXPECT_EQ(cv::norm(sent.left, pairAt(1.0).left, cv::NORM_INF), 0.0);
  EXPECT_GT(cv::norm(arrived.left, sent.left, cv::NORM_INF), 20.0);
  FaultFilter lasers = makeFilter("corrupt:lasers:0:9:1");
  LaserMeasurement turn;
  turn.scan.stamp = at(1.0);
  turn.scan.range_max = 80.0;
  turn.scan.ranges.assign(181, 5.0F);
  const auto arrived_turn = std::get<LaserMeasurement>(*applied(lasers, turn));
  for (const float range : arrived_turn.scan.ranges) {
    EXPECT_TRUE(std::isfinite(range));
    EXPECT_LE(range, 80.0F);
  }
}

TEST(FaultFilter, JumpsAndBlanks) {
  FaultFilter jump = makeFilter("jump:gps:0:9:-2.5");
  EXPECT_EQ(toStamp(*applied(jump, gpsAt(1.0))), at(-1.5));
  FaultFilter blank = makeFilter("nan:imu:0:9");
  const auto imu = std::get<ImuMeasurement>(*applied(blank, imuAt(1.0)));
  EXPECT_TRUE(std::isnan(imu.rate.x()));
  EXPECT_EQ(imu.stamp, at(1.0));
  FaultFilter black = makeFilter("nan:stereo:0:9");
  EXPECT_EQ(grey(std::get<StereoMeasurement>(*applied(black, pairAt(5.0))).right), 0);
}

LidarMeasurement sweepAt(double t) {
  LidarMeasurement lidar;
  lidar.stamp = at(t);
  lidar.sweep.reference = at(t - 0.05);
  lidar.sweep.beams.resize(200);
  for (urban_nav_core::Beam& beam : lidar.sweep.beams) beam.stamp = at(t - 0.1), beam.range = static_cast<float>(t);
  return lidar;
}

TEST(FaultFilter, SweepsFreezeWithTheirTimesAndBecomeInvalid) {
  FaultFilter freeze = makeFilter("freeze:lidar3d:1:1");
  applied(freeze, sweepAt(0.9));
  const auto frozen = std::get<LidarMeasurement>(*applied(freeze, sweepAt(1.5)));
  EXPECT_EQ(frozen.stamp, at(1.5));
  EXPECT_EQ(frozen.sweep.reference, at(1.45));
  EXPECT_EQ(frozen.sweep.beams[7].stamp, at(1.4));
  EXPECT_EQ(frozen.sweep.beams[7].range, 0.9F);
  FaultFilter blank = makeFilter("nan:lidar3d:0:9");
  EXPECT_TRUE(std::isnan(std::get<LidarMeasurement>(*applied(blank, sweepAt(1.0))).sweep.beams[0].range));
  FaultFilter lost = makeFilter("drop:lidar3d:0:9:1");
  EXPECT_FALSE(applied(lost, sweepAt(1.0)));
  FaultFilter corrupt = makeFilter("corrupt:lidar3d:0:9:0.5");
  const auto spoilt = std::get<LidarMeasurement>(*applied(corrupt, sweepAt(1.0)));
  int changed = 0;
  for (const urban_nav_core::Beam& beam : spoilt.sweep.beams) {
    EXPECT_TRUE(std::isfinite(beam.range));
    changed += beam.range != 1.0F;
  }
  EXPECT_NEAR(changed, 100, 30);
}

TEST(FaultFilter, ClocksDriftAndStayLate) {
  FaultFilter filter = makeFilter("drift:clock:1:2:0.4");
  EXPECT_EQ(toStamp(*applied(filter, pairAt(0.5))), at(0.5));
  EXPECT_EQ(toStamp(*applied(filter, pairAt(2.0))), at(2.2));
  EXPECT_EQ(toStamp(*applied(filter, pairAt(5.0))), at(5.4));
  EXPECT_EQ(toStamp(*applied(filter, imuAt(5.0))), at(5.0));
}

TEST(FaultFilter, RainBrightensAndNightDarkensCopies) {
  StereoMeasurement sent = pairAt(1.0);
  sent.left = cv::Mat(64, 64, CV_8UC1, cv::Scalar(100));
  sent.right = sent.left.clone();
  FaultFilter rain = makeFilter("rain:stereo:0:0:0.1");
  const auto wet = std::get<StereoMeasurement>(*applied(rain, sent));
  EXPECT_GT(cv::mean(wet.left)[0], 103.0);
  EXPECT_GT(cv::norm(wet.left, wet.right, cv::NORM_INF), 50.0) << "drops are near";
  EXPECT_EQ(cv::mean(sent.left)[0], 100.0);
  FaultFilter dark = makeFilter("dark:stereo:0:0:0.1");
  EXPECT_NEAR(cv::mean(std::get<StereoMeasurement>(*applied(dark, sent)).left)[0], 10.0, 0.5);
}

TEST(FaultFilter, AKnockTurnsTheRightImageAlone) {
  const Lens lens{64, 48, 60.0, 60.0, 32.0, 24.0, {}};
  FaultFilter filter({parseFault("knock:stereo:1:0:2")}, 7, kBegin, lens);
  StereoMeasurement sent{at(2.0), cv::Mat(48, 64, CV_8UC1), cv::Mat(48, 64, CV_8UC1)};
  for (int u = 0; u < 64; ++u) sent.left.col(u).setTo(2 * u), sent.right.col(u).setTo(2 * u);
  const auto arrived = std::get<StereoMeasurement>(*applied(filter, sent));
  EXPECT_EQ(cv::norm(arrived.left, sent.left, cv::NORM_INF), 0.0);
  // A camera that is turned to the right by 2 deg shows at a pixel what was 60 tan(2 deg) = 2.1 px further right.
  EXPECT_NEAR(arrived.right.at<std::uint8_t>(24, 32), 2.0 * (32.0 + 2.1), 1.0);
}

TEST(FaultFilter, SameBytesAgain) {
  for (int run = 0; run < 2; ++run) {
    static cv::Mat first;
    FaultFilter filter = makeFilter("corrupt:stereo:0:9");
    const auto arrived = std::get<StereoMeasurement>(*applied(filter, pairAt(1.0)));
    if (run == 0) first = arrived.left;
    else EXPECT_EQ(cv::norm(first, arrived.left, cv::NORM_INF), 0.0);
  }
}

}  // namespace
}  // namespace urban_nav_sim
