// SPDX-License-Identifier: BSD-3-Clause
#include "camera/lights.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "camera/heads.hpp"
#include "camera/render.hpp"
#include "ray_tracing/small_worlds.hpp"
#include "rig/sensor_poses.hpp"
#include "urban_nav_core/parallel/for_each.hpp"

namespace urban_nav_sim {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using urban_nav_core::Pose;

constexpr float kLampHeight = 4.0F;  // m
const Vector3f kLampIntensity(0.02F, 0.015F, 0.006F);

/// Plain ground with a lamp above the origin.
World litGround(Light light) {
  World world = emptyWorld();
  world.materials[kGround].detail = nullptr;
  world.materials[kGround].layers = {};
  world.day = makeDay(7, 1, light);
  world.parts.push_back(quad(kGround, {-30, -30, 0}, {60, 0, 0}, {0, 60, 0}));
  world.lamps.push_back({{0.0F, 0.0F, kLampHeight}, kLampIntensity});
  return world;
}

/// A picture of the ground from 8 m above the origin, and the radiance at a point of it.
class GroundPicture {
 public:
  explicit GroundPicture(const World& world, bool has_lights = true) {
    const Tracer tracer(world);
    const Sky sky = has_lights ? Sky(world, 1) : Sky(world.day, 1);
    render(Snapshot(tracer, 0, 0), sky, RayTable(lens_), T_world_camera_, Colours::Rgb, picture_);
  }
  Vector3f at(double x, double y) const {
    const auto pixel = *lens_.project(T_world_camera_.inverse() * Vector3d(x, y, 0.0));
    const std::size_t i =
        3 * picture_.at(static_cast<int>(std::lround(pixel.x())), static_cast<int>(std::lround(pixel.y())));
    return {picture_.radiance[i], picture_.radiance[i + 1], picture_.radiance[i + 2]};
  }
  const std::vector<float>& radiance() const { return picture_.radiance; }

 private:
  static Pose lookDown() {
    Eigen::Matrix3d down;
    down << 0, 1, 0, 1, 0, 0, 0, 0, -1;
    return Pose(down, Vector3d(0.0, 0.0, 8.0));
  }
  Lens lens_{400, 400, 280.0, 280.0, 199.5, 199.5, {}};
  Pose T_world_camera_ = lookDown();
  Picture picture_;
};

TEST(Lights, ALampLightsTheGroundByTheInverseSquare) {
  const World world = litGround(Light::Night);
  const GroundPicture picture(world);
  const Vector3f below = picture.at(0.0, 0.0);
  for (int i = 0; i < 3; ++i) {
    const float expected = world.materials[kGround].colours[0][i] * kLampIntensity[i] / (kLampHeight * kLampHeight);
    EXPECT_NEAR(below[i], expected, 0.08F * expected) << i;  // light scattered by the surroundings is added
  }
  // At 45 deg: twice the square of the distance, and the cosine.
  EXPECT_NEAR(picture.at(4.0, 0.0).y() / below.y(), std::sqrt(0.5F) / 2.0F, 0.03F);
}

TEST(Lights, AnObstacleBeforeALampCastsAShadow) {
  World world = litGround(Light::Night);
  world.parts.push_back(quad(kWall, {1, -2, 0.5F}, {0, 4, 0}, {0, 0, 1.5F}));  // from 0.5 to 2 m above the ground
  const GroundPicture picture(world);
  // The rays over its edges come down at x = 1 * 4 / (4 - 0.5) and 1 * 4 / (4 - 2).
  EXPECT_LT(picture.at(1.7, 0.0).y(), 0.2F * picture.at(-1.7, 0.0).y());
  EXPECT_NEAR(picture.at(2.4, 0.0).y(), picture.at(-2.4, 0.0).y(), 0.02F * picture.at(-2.4, 0.0).y());
}

TEST(Lights, DoNotBurnByDay) {
  const World world = litGround(Light::Day);
  EXPECT_FALSE(Lights(world).hasLamps());
  EXPECT_EQ(GroundPicture(world, true).radiance(), GroundPicture(world, false).radiance());
}

TEST(Lights, SameLightForAnyNumberOfThreads) {
  World world = yard();
  world.day = makeDay(7, 2, Light::Night);
  for (const float x : {-6.0F, -2.0F, 1.0F, 3.0F, 5.0F}) world.lamps.push_back({{x, 1.0F, 4.0F}, kLampIntensity});
  std::vector<std::vector<float>> radiances;
  for (const int threads : {1, 2}) {
    const urban_nav_core::ThreadLimit limit(threads);
    radiances.push_back(GroundPicture(world).radiance());
  }
  EXPECT_EQ(radiances[0], radiances[1]);
}

/// Returns the number of windows with light.
std::size_t countLit(const World& world) {
  const Lights lights(world);
  Appearance glass;
  glass.glass = 1.0F;
  std::size_t lit = 0;
  for (const Window& window : world.windows) {
    SurfacePoint point;
    point.position = Vector3f(1e5F, 1e5F, 0.0F);  // far from lamps
    point.corner = window.corner;
    lit += lights.own(point, glass).sum() > 0.0F ? 1U : 0U;
  }
  return lit;
}

TEST(Lights, AShareOfTheRoomsIsLitOthersOnAnotherDay) {
  World world = buildWorld("street", 7, 1, Light::Night);
  ASSERT_GT(world.windows.size(), 500U);
  const auto all = static_cast<double>(world.windows.size());
  const std::size_t at_night = countLit(world);
  EXPECT_GT(static_cast<double>(at_night), 0.2 * all);
  EXPECT_LT(static_cast<double>(at_night), 0.5 * all);
  EXPECT_EQ(countLit(world), at_night);
  world.day = makeDay(7, 1, Light::Dusk);
  const std::size_t at_dusk = countLit(world);
  EXPECT_GT(at_dusk, 0U);
  EXPECT_LT(at_dusk, at_night);
  world.day = makeDay(7, 2, Light::Night);
  EXPECT_NE(countLit(world), at_night);
  world.day = makeDay(7, 1);
  EXPECT_EQ(countLit(world), 0U);
}

/// Standard deviation of the noise relative to the mean, of the middle grey levels of a head's left image.
double relativeNoise(Light light) {
  World world = yard();
  world.day = makeDay(7, 1, light);
  for (const float y : {-2.0F, 0.0F, 2.0F}) world.lamps.push_back({{3.0F, y, 4.0F}, kLampIntensity});
  const Tracer tracer(world);
  const Sky sky(world, 1);
  CameraDefects quiet;
  quiet.is_noisy = false;
  std::array<cv::Mat, 2> images;
  for (const bool is_noisy : {false, true}) {
    StereoHead head(tracer, sky, StereoImages::Rectified, sensorPose("stereo_left_optical_frame"), 1,
                    is_noisy ? CameraDefects() : quiet);
    head.take(SteadyMotion(), 3.0)[0].convertTo(images[is_noisy ? 1 : 0], CV_32F);
  }
  cv::Mat inside;
  cv::inRange(images[0], 20, 200, inside);
  cv::Scalar bias, sigma;
  cv::meanStdDev(images[1] - images[0], bias, sigma, inside);
  EXPECT_GT(cv::countNonZero(inside), 1000);
  EXPECT_LT(std::abs(bias[0]), 1.0);
  return sigma[0] / cv::mean(images[0], inside)[0];
}

TEST(Lights, NoiseGrowsRelativeToTheSignalAsLightFails) {
  const double by_day = relativeNoise(Light::Day), at_dusk = relativeNoise(Light::Dusk),
               at_night = relativeNoise(Light::Night);
  EXPECT_GT(at_dusk, 1.5 * by_day);
  EXPECT_GT(at_night, 1.5 * at_dusk);
}

}  // namespace
}  // namespace urban_nav_sim
