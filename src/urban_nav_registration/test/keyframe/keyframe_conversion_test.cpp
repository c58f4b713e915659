// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/keyframe/keyframe_conversion.hpp"

#include <gtest/gtest.h>

#include "urban_nav_core/testing/motion.hpp"
#include "urban_nav_core/testing/textured_street.hpp"
#include "urban_nav_registration/session/calibration_fingerprint.hpp"
#include "urban_nav_registration/stereo/stereo_closure.hpp"
#include "urban_nav_registration/testing/photographer.hpp"

namespace urban_nav_registration {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::testing::lookingAlong;
using urban_nav_core::testing::RenderCamera;
using urban_nav_registration::testing::Photographer;

constexpr double kDistanceDriven = 1.5;  // m

/// Base poses of two days, and the transform between them measured with the cameras of both days.
class TwoCameras : public ::testing::Test {
 protected:
  /// Returns T_base1_base2 as measured, with the keyframe of the first day converted.
  StereoClosure measure(const RenderCamera& first, const Pose& T_base_first, const RenderCamera& second,
                        const Pose& T_base_second) {
    street_.setCamera(first);
    const MountedCamera from{street_.camera(), T_base_first};
    const Keyframe old = street_.keyframe(T_world_base1_ * T_base_first);
    street_.setCamera(second);
    const MountedCamera to{street_.camera(), T_base_second};
    const Keyframe now = street_.keyframe(T_world_base2_ * T_base_second);
    bool is_known = false;
    const auto conversion = findConversion(calibrationFingerprint(from.camera, from.T_base_left), to, is_known);
    EXPECT_TRUE(is_known);
    if (!conversion) return {};
    StereoClosure closure = StereoMatcher(to.camera, {}).match(conversion->convert(old), now);
    T_base1_base2_ = conversion->T_base_virtual() * betweenBases(closure.lefts, T_base_second).T_a_b;
    return closure;
  }
  void expectTruth(const StereoClosure& closure, double metres, double rad) const {
    EXPECT_EQ(closure.verdict, urban_nav_core::ClosureVerdict::Accepted) << closure.sentence;
    const Pose truth = T_world_base1_.inverse() * T_world_base2_;
    EXPECT_LT(distanceBetween(T_base1_base2_, truth), metres) << closure.sentence;
    EXPECT_LT(angleBetween(T_base1_base2_, truth), rad) << closure.sentence;
  }

  Photographer street_{urban_nav_core::testing::texturedStreet()};
  // Left optical axes along the street from base_link; base_link has the axes of the camera.
  Pose T_world_base1_ = lookingAlong({10.0, 0.0, 1.2}, 0.0);
  Pose T_world_base2_ = lookingAlong({10.0 + kDistanceDriven, 0.3, 1.2}, 0.05);
  Pose T_base1_base2_;
};

TEST_F(TwoCameras, RecalibratedMeasureTheTruth) {
  RenderCamera later;
  later.fx += 3.0, later.fy += 3.0;
  later.cx += 2.0;
  later.cy -= 1.0;
  const Pose mounted(urban_nav_core::expSo3(urban_nav_core::Vector3d(0.01, -0.008, 0.005)), {0.004, 0.002, -0.003});
  expectTruth(measure(RenderCamera(), Pose(), later, mounted), 0.03, 0.004);
}

TEST_F(TwoCameras, OfTwoRobotsMeasureTheTruth) {
  RenderCamera other;
  other.width = 400;
  other.height = 300;
  other.cx = 205.0;
  other.cy = 148.0;
  other.fx *= 0.85, other.fy *= 0.85;
  other.baseline *= 1.5;
  const Pose mounted(urban_nav_core::expSo3(urban_nav_core::Vector3d(0.03, -0.06, 0.02)), {0.4, -0.3, 0.2});
  expectTruth(measure(RenderCamera(), Pose(), other, mounted), 0.04, 0.006);
}

TEST_F(TwoCameras, ConvertedPointsKeepTheirPlaces) {
  const MountedCamera from{street_.camera(), Pose()};
  MountedCamera to = from;
  to.camera.left.fx *= 0.9, to.camera.left.fy *= 0.9, to.camera.baseline *= 2.0;
  const Keyframe old = street_.keyframe(T_world_base1_);
  const Keyframe result = KeyframeConversion(from, to).convert(old);
  ASSERT_EQ(result.points.size(), old.points.size());  // a wider view shows them all
  for (std::size_t i = 0; i < result.points.size(); ++i) {
    const KeyframePoint &before = old.points[i], &after = result.points[i];
    const double z_before = from.camera.left.fx * from.camera.baseline / static_cast<double>(before.disparity);
    const double z_after = to.camera.left.fx * to.camera.baseline / static_cast<double>(after.disparity);
    EXPECT_NEAR(z_after / z_before, 1.0, 0.1) << "moved to a whole pixel along its surface";
    const Eigen::Vector3d ray_before = from.camera.left.ray(before.pixel()),
                          ray_after = to.camera.left.ray(after.pixel());
    EXPECT_LT((ray_before - ray_after).norm(), 0.8 * (1 << after.level) / to.camera.left.fx);
  }
}

TEST(FindConversion, IsNullForTheSameCameraAndRefusesWhatItCannotRead) {
  const MountedCamera camera{Photographer(urban_nav_core::testing::texturedStreet()).camera(), Pose()};
  const std::string words = calibrationFingerprint(camera.camera, camera.T_base_left);
  bool is_known = false;
  EXPECT_EQ(findConversion(words, camera, is_known), nullptr);
  EXPECT_TRUE(is_known);
  for (const std::string& damaged :
       {std::string(), std::string("640x480 1 2 3"), words + " nan", words + " 1 2", "0" + words.substr(3)}) {
    EXPECT_EQ(findConversion(damaged, camera, is_known), nullptr) << damaged;
    EXPECT_FALSE(is_known) << damaged;
  }
}

TEST(ParseCalibrationFingerprint, ReturnsWhatWasPrinted) {
  MountedCamera camera{Photographer(urban_nav_core::testing::texturedStreet()).camera(),
                       Pose(urban_nav_core::expSo3(urban_nav_core::Vector3d(0.1, 0.2, -0.3)), {1.0, 2.0, 3.0})};
  camera.camera.disparity_offset = 1.25;
  const std::string words = calibrationFingerprint(camera.camera, camera.T_base_left);
  const auto parsed = parseCalibrationFingerprint(words);
  ASSERT_TRUE(parsed);
  EXPECT_EQ(calibrationFingerprint(parsed->camera, parsed->T_base_left), words);
  EXPECT_EQ(parsed->camera.disparity_offset, 1.25);
}

}  // namespace
}  // namespace urban_nav_registration
