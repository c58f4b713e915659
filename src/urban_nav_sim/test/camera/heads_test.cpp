// SPDX-License-Identifier: BSD-3-Clause
#include "camera/heads.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>
#include <opencv2/imgproc.hpp>

#include "ray_tracing/small_worlds.hpp"
#include "rig/sensor_poses.hpp"
#include "urban_nav_core/parallel/for_each.hpp"

namespace urban_nav_sim {
namespace {

using urban_nav_core::Pose;

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.at(values.size() / 2);
}

std::vector<double> magnitudes(std::vector<double> values) {
  for (double& value : values) value = std::abs(value);
  return values;
}

CameraDefects none() {
  CameraDefects defects;
  defects.blurs = defects.is_noisy = defects.vignettes = false;
  return defects;
}

/// Best shift of a patch along the row, by normalised correlation and a parabola; shares nothing with the renderer.
double measureShift(const cv::Mat& left, const cv::Mat& right, int u, int v, double guess) {
  const cv::Rect patch(u - 8, v - 8, 17, 17);
  const int from = u - 8 - static_cast<int>(std::lround(guess)) - 4;
  if (from < 0 || patch.x + 17 > left.cols) return NAN;
  cv::Mat scores;
  cv::matchTemplate(right(cv::Rect(from, v - 8, 17 + 8, 17)), left(patch), scores, cv::TM_CCOEFF_NORMED);
  cv::Point best;
  cv::minMaxLoc(scores, nullptr, nullptr, nullptr, &best);
  if (best.x == 0 || best.x == 8 || scores.at<float>(0, best.x) < 0.9F) return NAN;
  const double a = scores.at<float>(0, best.x - 1), b = scores.at<float>(0, best.x),
               c = scores.at<float>(0, best.x + 1);
  return u - 8 - (from + best.x + 0.5 * (a - c) / (a - 2 * b + c));
}

std::vector<double> disparityErrors(const std::array<cv::Mat, 2>& images, const Picture& left) {
  std::vector<double> errors;
  for (int v = 20; v < 364; v += 6) {
    for (int u = 20; u < 492; u += 6) {
      const double depth = static_cast<double>(left.depth[left.at(u, v)]);
      if (left.surface_class[left.at(u, v)] != static_cast<int>(SurfaceClass::TexturedWall)) continue;
      const double d = measureShift(images[0], images[1], u, v, 46.797 / depth);
      if (std::isfinite(d)) errors.push_back(d - 46.797 / depth);
    }
  }
  return errors;
}

struct HeadScene {
  World world = yard();
  Tracer tracer{world};
  Sky sky{world.day, 1};
  Pose T_base_left = sensorPose("stereo_left_optical_frame");
};

TEST(StereoHead, DisparityOfTheTextureIsThatOfTheGeometry) {
  const HeadScene scene;
  StereoHead head(scene.tracer, scene.sky, StereoImages::Rectified, scene.T_base_left, 1, none());
  const auto images = head.take(SteadyMotion(), 3.0);
  const auto errors = disparityErrors(images, head.pictures()[0]);
  ASSERT_GT(errors.size(), 300U);
  EXPECT_LT(median(magnitudes(errors)), 0.05);
}

TEST(StereoHead, AndSoItIsAfterRectificationOfTheDistortedImages) {
  const HeadScene scene;
  StereoHead raw(scene.tracer, scene.sky, StereoImages::Raw, scene.T_base_left, 1, none());
  StereoHead rectified(scene.tracer, scene.sky, StereoImages::Rectified, scene.T_base_left, 1, none());
  const auto images = raw.take(SteadyMotion(), 3.0), direct = rectified.take(SteadyMotion(), 3.0);
  std::array<cv::Mat, 2> mapped;
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& info = raw.cameras()[i].info;
    cv::Mat K, R, P, map_u, map_v;
    cv::eigen2cv(info.K, K);
    cv::eigen2cv(info.R, R);
    cv::eigen2cv(Eigen::Matrix3d(info.P.leftCols<3>()), P);
    cv::initUndistortRectifyMap(K, info.D, R, P, {512, 384}, CV_32FC1, map_u, map_v);
    cv::remap(images[i], mapped[i], map_u, map_v, cv::INTER_CUBIC);
  }
  const auto errors = disparityErrors(mapped, rectified.pictures()[0]);
  ASSERT_GT(errors.size(), 200U);
  EXPECT_LT(std::abs(median(errors)), 0.05);
  EXPECT_LT(median(magnitudes(errors)), 0.05);
  // The remapped image is the one that was rendered directly.
  cv::Mat difference;
  cv::absdiff(mapped[0](cv::Rect(40, 40, 430, 300)), direct[0](cv::Rect(40, 40, 430, 300)), difference);
  EXPECT_LT(cv::mean(difference)[0], 8.0);
}

TEST(StereoHead, SameBytesForAnyNumberOfThreadsAndOthersForAnotherSeed) {
  const HeadScene scene;
  std::vector<cv::Mat> images;
  for (const int threads : {1, 2}) {
    const urban_nav_core::ThreadLimit limit(threads);
    StereoHead head(scene.tracer, scene.sky, StereoImages::Raw, scene.T_base_left, 1);
    head.take(SteadyMotion(1.0, 0.5), 0.5);
    images.push_back(head.take(SteadyMotion(1.0, 0.5), 0.55)[1]);
  }
  StereoHead other(scene.tracer, scene.sky, StereoImages::Raw, scene.T_base_left, 2);
  other.take(SteadyMotion(1.0, 0.5), 0.5);
  images.push_back(other.take(SteadyMotion(1.0, 0.5), 0.55)[1]);
  EXPECT_EQ(cv::norm(images[0], images[1], cv::NORM_INF), 0.0);
  EXPECT_GT(cv::norm(images[0], images[2], cv::NORM_INF), 1.0);
}

TEST(StereoHead, NoiseIsAboutOneGreyLevel) {
  const HeadScene scene;
  StereoHead noisy(scene.tracer, scene.sky, StereoImages::Rectified, scene.T_base_left, 1);
  CameraDefects defects;
  defects.is_noisy = false;
  StereoHead clean(scene.tracer, scene.sky, StereoImages::Rectified, scene.T_base_left, 1, defects);
  cv::Mat a, b;
  noisy.take(SteadyMotion(), 3.0)[0].convertTo(a, CV_32F);
  clean.take(SteadyMotion(), 3.0)[0].convertTo(b, CV_32F);
  cv::Mat inside;
  cv::inRange(b, 20, 200, inside);
  cv::Scalar mean, sigma;
  cv::meanStdDev(a - b, mean, sigma, inside);
  EXPECT_NEAR(mean[0], 0.0, 0.03);
  EXPECT_GT(sigma[0], 0.6);
  EXPECT_LT(sigma[0], 1.8);
}

TEST(LadybugHead, TakesFiveUprightColourImages) {
  const HeadScene scene;
  LadybugHead head(scene.tracer, scene.sky, Pose(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0, 0, 1.4)), 1);
  const auto images = head.take(SteadyMotion(0.5), 1.0);
  for (std::size_t i = 0; i < 5; ++i) {
    ASSERT_EQ(images[i].size(), cv::Size(384, 512));
    ASSERT_EQ(images[i].type(), CV_8UC3);
    const auto& picture = head.pictures()[i];
    // Ground below.
    EXPECT_EQ(picture.surface_class[picture.at(192, 500)],
              static_cast<int>(scene.world.materials[kGround].surface_class));
  }
  EXPECT_TRUE(std::isinf(head.pictures()[2].depth[head.pictures()[2].at(192, 5)]));  // sky above
  // Sky is blue or white: no less blue than red, so the channels are in OpenCV's order.
  const cv::Scalar sky = cv::mean(images[2](cv::Rect(150, 0, 80, 40)));
  EXPECT_GE(sky[0], sky[2] - 3.0);
}

TEST(MotionBlur, FlowIsTheMotionOfThePixel) {
  const HeadScene scene;
  const SteadyMotion motion(1.2, 0.9);
  for (const auto images : {StereoImages::Raw, StereoImages::Rectified}) {
    const Camera camera = bumblebee(images)[1];
    const RayTable rays(camera.lens);
    const Pose T_base_camera = scene.T_base_left * camera.T_head_camera;
    const CameraMotion camera_motion = computeCameraMotion(motion.at(1.0), T_base_camera);
    for (const double depth : {1.5, 20.0}) {
      const Eigen::Vector2d pixel(400.0, 90.0);
      const auto ideal = camera.lens.idealAt(pixel);
      const Eigen::Vector3d p = motion.at(1.0).T_world_base * T_base_camera *
                                Eigen::Vector3d(depth * Eigen::Vector3d(ideal->x(), ideal->y(), 1.0));
      const auto seen = [&](double t) {
        return *camera.lens.project((motion.at(t).T_world_base * T_base_camera).inverse() * p);
      };
      const Eigen::Vector2d numeric = (seen(1.0005) - seen(0.9995)) / 1e-3;
      const Eigen::Vector2f flow = flowAt(rays, 400, 90, static_cast<float>(depth), camera_motion);
      EXPECT_LT((flow.cast<double>() - numeric).norm(), 0.01 * numeric.norm());
    }
  }
}

TEST(AutoExposure, SettlesOnItsTargetAfterALag) {
  Picture picture;
  picture.width = picture.height = 30;
  picture.radiance.assign(900, 0.2F);
  AutoExposure exposure;
  const auto grey = [&](const Exposure& e) {
    return 0.2 * exposure.levels(e) * static_cast<double>(picture.radiance[0]) / 0.2;
  };
  EXPECT_NEAR(grey(exposure.next(picture)), 110.0, 1.0);  // it has looked at this for a while
  picture.radiance.assign(900, 0.1F);
  EXPECT_NEAR(grey(exposure.next(picture)), 55.0, 1.0);  // not yet
  double last = 0.0, highest = 0.0;
  for (int i = 0; i < 40; ++i) {
    last = grey(exposure.next(picture));
    highest = std::max(highest, last);
  }
  EXPECT_NEAR(last, 110.0, 2.0);
  EXPECT_LT(highest, 130.0);
  AutoExposure::Settings fixed;
  fixed.adapts = false;
  AutoExposure held(fixed);
  const double first = held.levels(held.next(picture));
  picture.radiance.assign(900, 0.8F);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(held.levels(held.next(picture)), first);
  picture.radiance.assign(900, 0.001F);
  for (int i = 0; i < 100; ++i) exposure.next(picture);
  const Exposure dark = exposure.next(picture);
  EXPECT_NEAR(dark.seconds, 0.010, 1e-9);
  EXPECT_NEAR(dark.gain, 8.0, 1e-6);
}

}  // namespace
}  // namespace urban_nav_sim
