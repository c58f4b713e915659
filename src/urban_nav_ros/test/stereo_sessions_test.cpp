// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/stereo_sessions.hpp"

#include <gtest/gtest.h>

#include <boost/make_shared.hpp>
#include <vector>

#include "urban_nav_ros/camera_info.hpp"
#include "urban_nav_ros/image.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_ros {
namespace {

using urban_nav_core::StampNs;

constexpr StampNs kSessionMs = 1'000'000, kSessionStart = 1'600'000'000'000'000'000;

urban_nav_core::StereoCamera sessionCamera(double baseline = 0.12) {
  urban_nav_core::StereoCamera camera;
  const double focal_length = 80.0 + baseline;  // in both camera_info, whereas only the right one has the baseline
  camera.left = {focal_length, focal_length, 47.5, 35.5, 96, 72};
  camera.baseline = baseline;
  return camera;
}

InfoInput makeInfo(Side side, const urban_nav_core::CameraInfo& info) {
  auto message = boost::make_shared<sensor_msgs::CameraInfo>(toCameraInfoMessage(info));
  message->header.frame_id = side == Side::Left ? "left" : "right";
  return {side, message};
}

ImageInput toImage(Side side, StampNs stamp, int width = 96) {
  auto message = boost::make_shared<sensor_msgs::Image>(toImageMessage(cv::Mat(72, width, CV_8UC1, cv::Scalar(9))));
  message->header.stamp = toRosTime(stamp);
  return {side, sensor_msgs::ImageConstPtr(message), stamp};
}

tf2_msgs::TFMessageConstPtr mountingAt(double height) {
  auto message = boost::make_shared<tf2_msgs::TFMessage>();
  message->transforms.push_back(toStaticTransform(
      "base_link", "left", urban_nav_core::Pose(opticalInBody().q(), urban_nav_core::Vector3d(0.0, 0.0, height))));
  return message;
}

/// Sessions that record their events.
struct Kept {
  explicit Kept(double tf_timeout = 0.0, urban_nav_core::MotionChoice motion = {}) {
    options.tf_timeout = tf_timeout;
    options.motion = motion;
    sessions = std::make_unique<StereoSessions>(
        options, StereoSessions::Listener{[this](const StereoSessions::Camera& camera) { cameras.push_back(camera); },
                                          [this](DecodedPair& pair) {
                                            stamps.push_back(pair.assembled.pair.stamp);
                                            motions.push_back(pair.assembled.inputs.size());
                                          },
                                          [this](const std::string& why) { ends.push_back(why); },
                                          [this](const std::string& fault) { faults.push_back(fault); }});
  }
  void calibrate(double baseline = 0.12) {
    sessions->handle(makeInfo(Side::Left, leftInfo(sessionCamera(baseline))));
    sessions->handle(makeInfo(Side::Right, rightInfo(sessionCamera(baseline))));
  }
  void show(StampNs stamp) {
    sessions->handle(toImage(Side::Left, stamp));
    sessions->handle(toImage(Side::Right, stamp));
  }
  StereoSessions::Options options;
  std::unique_ptr<StereoSessions> sessions;
  std::vector<StereoSessions::Camera> cameras;
  std::vector<StampNs> stamps;
  std::vector<std::size_t> motions;  // inputs of each pair
  std::vector<std::string> ends, faults;
};

TEST(StereoSessions, KeepImagesUntilTheCalibrationIsKnown) {
  Kept kept;
  kept.show(kSessionStart);
  kept.show(kSessionStart + 50 * kSessionMs);
  EXPECT_TRUE(kept.stamps.empty());
  EXPECT_FALSE(kept.sessions->isRunning());
  kept.calibrate();
  EXPECT_TRUE(kept.sessions->isRunning());
  EXPECT_EQ(kept.stamps, (std::vector<StampNs>{kSessionStart, kSessionStart + 50 * kSessionMs}));
  EXPECT_EQ(kept.sessions->counts().pairs, 2);
}

TEST(StereoSessions, WaitForTheMounting) {
  Kept kept(3600.0);
  kept.calibrate();
  kept.show(kSessionStart);
  kept.sessions->idle();
  EXPECT_TRUE(kept.cameras.empty());
  kept.sessions->handle(mountingAt(1.5));
  ASSERT_EQ(kept.cameras.size(), 1U);
  EXPECT_TRUE(kept.cameras[0].is_mounting_known);
  EXPECT_EQ(kept.cameras[0].T_base_left.t().z(), 1.5);
  EXPECT_EQ(kept.stamps.size(), 1U);
}

TEST(StereoSessions, WithoutAMountingTheCameraIsAtTheBase) {
  Kept kept;
  kept.calibrate();
  kept.show(kSessionStart);
  ASSERT_EQ(kept.cameras.size(), 1U);
  EXPECT_FALSE(kept.cameras[0].is_mounting_known);
  EXPECT_EQ(kept.cameras[0].T_base_left.t(), urban_nav_core::Vector3d::Zero());
  EXPECT_NE(kept.cameras[0].sentence().find("96x72 px, rectified already; no static tf"), std::string::npos);
}

TEST(StereoSessions, AMountingThatComesLateOrChangesBeginsTheNextSession) {
  Kept kept;
  kept.calibrate();
  kept.show(kSessionStart);
  EXPECT_NE(kept.sessions->placeFault().find("no static tf from base_link to left"), std::string::npos);
  kept.sessions->handle(mountingAt(1.5));
  EXPECT_EQ(kept.ends, std::vector<std::string>{"the mounting of the camera was received"});
  kept.show(kSessionStart + 50 * kSessionMs);
  ASSERT_EQ(kept.cameras.size(), 2U);
  EXPECT_TRUE(kept.cameras[1].is_mounting_known);
  EXPECT_EQ(kept.cameras[1].T_base_left.t().z(), 1.5);
  EXPECT_EQ(kept.sessions->placeFault(), "");
  kept.sessions->handle(mountingAt(1.5));
  EXPECT_EQ(kept.ends.size(), 1U) << "the same";
  kept.sessions->handle(mountingAt(1.6));
  EXPECT_EQ(kept.ends.back(), "the mounting of the camera changed");
  kept.show(kSessionStart + 100 * kSessionMs);
  EXPECT_EQ(kept.cameras.back().T_base_left.t().z(), 1.6);
  EXPECT_EQ(kept.stamps.size(), 3U) << "no pair is lost";
}

TEST(StereoSessions, AJumpBackInTimeEndsTheSession) {
  Kept kept;
  kept.calibrate();
  kept.show(kSessionStart);
  kept.sessions->handle(toImage(Side::Left, kSessionStart + 50 * kSessionMs));
  kept.show(kSessionStart - 2000 * kSessionMs);
  EXPECT_EQ(kept.ends, std::vector<std::string>{"time went back"});
  EXPECT_EQ(kept.cameras.size(), 2U);
  const std::vector<StampNs> expected{kSessionStart, kSessionStart + 50 * kSessionMs,
                                      kSessionStart - 2000 * kSessionMs};
  EXPECT_EQ(kept.stamps, expected) << "waiting pairs are delivered first";
  EXPECT_EQ(kept.sessions->counts().right_missing, 1);
}

TEST(StereoSessions, AnImageThatIsOvertakenByTheJumpBackEndsNoSecondSession) {
  Kept kept;
  kept.calibrate();
  kept.show(kSessionStart);
  kept.sessions->handle(toImage(Side::Left, kSessionStart + 50 * kSessionMs));
  kept.sessions->handle(toImage(Side::Left, kSessionStart - 60'000 * kSessionMs));
  kept.sessions->handle(toImage(Side::Right, kSessionStart + 50 * kSessionMs));
  kept.sessions->handle(toImage(Side::Left, kSessionStart - 59'950 * kSessionMs));
  kept.sessions->handle(toImage(Side::Right, kSessionStart - 60'000 * kSessionMs));
  kept.sessions->handle(toImage(Side::Right, kSessionStart - 59'950 * kSessionMs));
  EXPECT_EQ(kept.ends, std::vector<std::string>{"time went back"});
  const std::vector<StampNs> expected{kSessionStart, kSessionStart + 50 * kSessionMs,
                                      kSessionStart - 60'000 * kSessionMs, kSessionStart - 59'950 * kSessionMs};
  EXPECT_EQ(kept.stamps, expected);
  EXPECT_EQ(kept.sessions->counts().right_missing, 0);
}

TEST(StereoSessions, AMessageOfAGyroscopeFromBeforeAJumpBackDoesNotSilenceIt) {
  Kept kept(0.0, urban_nav_core::MotionChoice{true, false, false});
  const auto turn = [&kept](StampNs stamp) {
    auto message = boost::make_shared<sensor_msgs::Imu>();
    message->header.stamp = toRosTime(stamp);
    message->angular_velocity.z = 0.1;
    kept.sessions->handle(sensor_msgs::ImuConstPtr(message));
  };
  kept.calibrate();
  turn(kSessionStart);
  kept.show(kSessionStart);
  const StampNs again = kSessionStart - 60'000 * kSessionMs;
  kept.show(again);
  turn(kSessionStart + 10 * kSessionMs);  // late
  for (int i = 0; i < 10; ++i) turn(again + i * 10 * kSessionMs);
  kept.show(again + 50 * kSessionMs);
  kept.show(again + 200 * kSessionMs);
  ASSERT_EQ(kept.stamps.size(), 3U);
  EXPECT_EQ(kept.motions[2], 5U) << "increments from the first frame to the second";
}

TEST(StereoSessions, AnotherCalibrationEndsTheSessionUntilBothSidesHaveIt) {
  Kept kept;
  kept.calibrate();
  kept.show(kSessionStart);
  kept.calibrate();
  EXPECT_TRUE(kept.ends.empty()) << "the same calibration";
  kept.sessions->handle(makeInfo(Side::Left, leftInfo(sessionCamera(0.2))));
  EXPECT_EQ(kept.ends, std::vector<std::string>{"the calibration changed"});
  kept.show(kSessionStart + 50 * kSessionMs);
  EXPECT_EQ(kept.cameras.size(), 1U);
  kept.sessions->handle(makeInfo(Side::Right, rightInfo(sessionCamera(0.2))));
  ASSERT_EQ(kept.cameras.size(), 2U);
  EXPECT_NEAR(kept.cameras[1].camera.baseline, 0.2, 1e-9);
  EXPECT_EQ(kept.stamps.size(), 2U);
}

TEST(StereoSessions, ACalibrationThatIsNoStereoPairIsRefusedOnce) {
  Kept kept;
  kept.show(kSessionStart);
  kept.sessions->handle(makeInfo(Side::Left, leftInfo(sessionCamera())));
  kept.sessions->handle(makeInfo(Side::Right, leftInfo(sessionCamera())));
  kept.sessions->idle();
  ASSERT_EQ(kept.faults.size(), 1U);
  EXPECT_FALSE(kept.sessions->fault().empty());
  kept.sessions->handle(makeInfo(Side::Right, rightInfo(sessionCamera())));
  kept.sessions->handle(makeInfo(Side::Left, leftInfo(sessionCamera())));
  EXPECT_EQ(kept.sessions->fault(), "");
  EXPECT_EQ(kept.stamps.size(), 1U);
}

TEST(StereoSessions, CountDamagedImages) {
  Kept kept;
  kept.calibrate();
  kept.sessions->handle(toImage(Side::Left, kSessionStart, 50));
  kept.sessions->handle(toImage(Side::Right, kSessionStart));
  EXPECT_EQ(kept.stamps.size(), 1U);
  EXPECT_EQ(kept.sessions->counts().damaged, 1);
  urban_nav_live::StageReport report;
  kept.sessions->counts().addTo(report);
  EXPECT_FALSE(report.figures.empty());
}

TEST(StereoSessions, AnEndWithoutDeliveryDropsWaitingInputs) {
  Kept kept;
  kept.calibrate();
  kept.show(kSessionStart);
  kept.sessions->handle(toImage(Side::Left, kSessionStart + 50 * kSessionMs));
  kept.sessions->end("shutdown", false);
  EXPECT_EQ(kept.stamps.size(), 1U);
  EXPECT_EQ(kept.ends, std::vector<std::string>{"shutdown"});
  kept.sessions->end("shutdown");
  EXPECT_EQ(kept.ends.size(), 1U);
}

}  // namespace
}  // namespace urban_nav_ros
