// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/camera/rectify.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <random>

#include "support/opencv.hpp"
#include "urban_nav_core/image/fast.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core {
namespace {

// EuRoC's V1_01: the two raw cameras and their poses on the body.
RawCamera left() {
  return {{458.654, 457.296, 367.215, 248.375, 752, 480},
          Distortion({-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05, 0.0, 0.0, 0.0, 0.0})};
}

RawCamera right() {
  return {{457.587, 456.134, 379.999, 255.238, 752, 480},
          Distortion({-0.28368365, 0.07451284, -0.00010473, -3.55590700e-05, 0.0, 0.0, 0.0, 0.0})};
}

Pose T_right_left() {
  Matrix3d left_in_body, right_in_body;
  left_in_body << 0.0148655429818, -0.999880929698, 0.00414029679422, 0.999557249008, 0.0149672133247, 0.025715529948,
      -0.0257744366974, 0.00375618835797, 0.999660727178;
  right_in_body << 0.0125552670891, -0.999755099723, 0.0182237714554, 0.999598781151, 0.0130119051815, 0.0251588363115,
      -0.0253898008918, 0.0179005838253, 0.999517347078;
  return Pose(right_in_body, Vector3d(-0.0198435579556, 0.0453689425024, 0.00786212447038)).inverse() *
         Pose(left_in_body, Vector3d(-0.0216401454975, -0.064676986768, 0.00981073058949));
}

cv::Matx33d toCv(const Matrix3d& R) {
  return {R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2)};
}
cv::Mat smoothImage(int width, int height) {
  cv::Mat image(height, width, CV_8U);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      image.at<std::uint8_t>(v, u) =
          cv::saturate_cast<std::uint8_t>(128 + 60 * std::sin(u * 0.11) + 50 * std::cos(v * 0.07 + u * 0.02));
    }
  }
  return image;
}

TEST(Rectify, MapsAgreeWithOpenCv) {
  const StereoRectification pair = rectifyStereo(left(), right(), T_right_left(), "here");
  const RectifyMap map(right(), pair.R_right, pair.camera.left);
  cv::Mat u_map, v_map;
  cv::initUndistortRectifyMap(K(right().pinhole), D(right().distortion), toCv(pair.R_right), K(pair.camera.left),
                              cv::Size(752, 480), CV_32FC1, u_map, v_map);
  std::vector<cv::Point3d> rays;
  std::vector<Eigen::Vector2d> ours;
  for (int v = 0; v < 480; v += 11) {
    for (int u = 0; u < 752; u += 11) {
      const auto pixel = map.rawPixel({static_cast<double>(u), static_cast<double>(v)});
      ASSERT_TRUE(pixel);
      EXPECT_NEAR(pixel->x(), u_map.at<float>(v, u), 1e-4) << "OpenCV's map is of floats";
      EXPECT_NEAR(pixel->y(), v_map.at<float>(v, u), 1e-4);
      const Eigen::Vector3d ray =
          pair.R_right.transpose() * pair.camera.left.ray({static_cast<double>(u), static_cast<double>(v)});
      rays.emplace_back(ray.x(), ray.y(), ray.z());
      ours.push_back(*pixel);
    }
  }
  std::vector<cv::Point2d> exact;
  cv::projectPoints(rays, cv::Vec3d(0, 0, 0), cv::Vec3d(0, 0, 0), K(right().pinhole), D(right().distortion), exact);
  for (std::size_t i = 0; i < ours.size(); ++i) {
    EXPECT_NEAR(ours[i].x(), exact[i].x, 1e-6);
    EXPECT_NEAR(ours[i].y(), exact[i].y, 1e-6);
  }
}

TEST(Rectify, RowsOfThePairAgreeAndDisparityIsThatOfTheBaseline) {
  const StereoRectification pair = rectifyStereo(left(), right(), T_right_left(), "here");
  EXPECT_NEAR(pair.camera.baseline, 0.110073, 1e-5);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> xy(-0.8, 0.8), z(0.5, 20.0);
  for (int i = 0; i < 300; ++i) {
    const double depth = z(random);
    const Vector3d p_left(xy(random) * depth, xy(random) * depth, depth);
    const Vector3d ray_left = *left().ray(*left().project(p_left));
    const Vector3d ray_right = *right().ray(*right().project(T_right_left() * p_left));
    const auto a = pair.camera.left.project(pair.R_left * ray_left);
    const auto b = pair.camera.left.project(pair.R_right * ray_right);
    const auto expected = pair.camera.project(pair.R_left * p_left);
    ASSERT_TRUE(a && b && expected);
    EXPECT_NEAR(a->y(), b->y(), 1e-7);
    EXPECT_NEAR(a->x(), (*expected)(0), 1e-7);
    EXPECT_NEAR(b->x(), (*expected)(2), 1e-7);
  }
}

TEST(Rectify, TheViewIsCoveredByBothAndNotMuchSmallerThanItCouldBe) {
  const StereoRectification pair = rectifyStereo(left(), right(), T_right_left(), "here");
  const RectifyMap a(left(), pair.R_left, pair.camera.left), b(right(), pair.R_right, pair.camera.left);
  EXPECT_EQ(a.coveredShare(), 1.0);
  EXPECT_EQ(b.coveredShare(), 1.0);
  Pinhole wider = pair.camera.left;
  wider.fx *= 0.97;
  wider.fy *= 0.97;
  const double share = std::min(RectifyMap(left(), pair.R_left, wider).coveredShare(),
                                RectifyMap(right(), pair.R_right, wider).coveredShare());
  EXPECT_LT(share, 1.0);
}

TEST(Rectify, RemapIsBilinearToTheGridOfTheTable) {
  const StereoRectification pair = rectifyStereo(left(), right(), T_right_left(), "here");
  const RectifyMap map(left(), pair.R_left, pair.camera.left);
  const cv::Mat raw = smoothImage(752, 480);
  std::vector<std::uint8_t> out;
  const ImageView rectified = map.remap(view(raw), out);
  ASSERT_EQ(rectified.width, 752);
  ASSERT_EQ(rectified.height, 480);
  int checked = 0;
  for (int v = 0; v < 480; v += 3) {
    for (int u = 0; u < 752; u += 3) {
      const Eigen::Vector2d p = *map.rawPixel({static_cast<double>(u), static_cast<double>(v)});
      const int u0 = std::min(static_cast<int>(p.x()), 750), v0 = std::min(static_cast<int>(p.y()), 478);
      const double a = p.x() - u0, b = p.y() - v0;
      const double expected =
          (1 - b) * ((1 - a) * raw.at<std::uint8_t>(v0, u0) + a * raw.at<std::uint8_t>(v0, u0 + 1)) +
          b * ((1 - a) * raw.at<std::uint8_t>(v0 + 1, u0) + a * raw.at<std::uint8_t>(v0 + 1, u0 + 1));
      ASSERT_NEAR(rectified.at(u, v), expected, 0.56) << u << ", " << v;
      ++checked;
    }
  }
  EXPECT_GT(checked, 10000);
}

TEST(Rectify, TheIdentityCopiesEveryPixelTheLastRowAndColumnToo) {
  const Pinhole pinhole{300.0, 300.0, 160.0, 120.0, 333, 241};
  const RectifyMap map({pinhole, Distortion()}, Matrix3d::Identity(), pinhole);
  EXPECT_EQ(map.coveredShare(), 1.0);
  cv::Mat raw(241, 333, CV_8U);
  cv::theRNG().state = 3;
  cv::randu(raw, 0, 256);
  // The copy ends with its last pixel, so that the address sanitizer detects reads beyond it.
  const std::vector<std::uint8_t> exact(raw.datastart, raw.dataend);
  std::vector<std::uint8_t> out;
  map.remap({exact.data(), 333, 241, 333}, out);
  EXPECT_EQ(out, exact);
}

TEST(Rectify, WhatTheRawImageDoesNotCoverIsItsBorder) {
  const Pinhole narrow{300.0, 300.0, 50.0, 40.0, 101, 81}, wide{150.0, 150.0, 50.0, 40.0, 101, 81};
  const RectifyMap map({narrow, Distortion()}, Matrix3d::Identity(), wide);
  EXPECT_NEAR(map.coveredShare(), 0.25, 0.02);
  EXPECT_FALSE(map.isCovered(0, 40));
  EXPECT_TRUE(map.isCovered(50, 40));
  const cv::Mat raw = smoothImage(101, 81);
  std::vector<std::uint8_t> out;
  const ImageView rectified = map.remap(view(raw), out);
  EXPECT_EQ(rectified.at(0, 0), raw.at<std::uint8_t>(0, 0));
  EXPECT_EQ(rectified.at(100, 80), raw.at<std::uint8_t>(80, 100));
}

TEST(Rectify, AnImageOfAnotherSizeGivesNone) {
  const Pinhole pinhole{300.0, 300.0, 50.0, 40.0, 101, 81};
  const RectifyMap map({pinhole, Distortion()}, Matrix3d::Identity(), pinhole);
  const cv::Mat other = smoothImage(100, 81);
  std::vector<std::uint8_t> out;
  EXPECT_TRUE(map.remap(view(other), out).empty());
  EXPECT_TRUE(map.remap(ImageView{}, out).empty());
}

/// Row, to a fraction of a pixel, at which the right image fits a patch of the left best; empty if no place fits well.
std::optional<double> matchedRow(const cv::Mat& left_image, const cv::Mat& right_image, int u, int v) {
  constexpr int kHalf = 7, kRows = 4, kDisparities = 90;
  if (u < kDisparities + kHalf || u >= left_image.cols - kHalf || v < kHalf + kRows ||
      v >= left_image.rows - kHalf - kRows)
    return {};
  const cv::Mat patch = left_image(cv::Rect(u - kHalf, v - kHalf, 2 * kHalf + 1, 2 * kHalf + 1));
  const cv::Mat band = right_image(
      cv::Rect(u - kHalf - kDisparities, v - kHalf - kRows, 2 * kHalf + 1 + kDisparities, 2 * (kHalf + kRows) + 1));
  cv::Mat score;
  cv::matchTemplate(band, patch, score, cv::TM_CCOEFF_NORMED);
  double best = 0.0;
  cv::Point at;
  cv::minMaxLoc(score, nullptr, &best, nullptr, &at);
  if (best < 0.95 || at.y == 0 || at.y == score.rows - 1) return {};
  const double above = score.at<float>(at.y - 1, at.x), below = score.at<float>(at.y + 1, at.x);
  return at.y - kRows + 0.5 * (above - below) / (above - 2.0 * best + below);
}

TEST(Rectify, RowsOfARealPairAgree) {
  const char* data = std::getenv("URBAN_NAV_DATA");
  const std::filesystem::path folder = std::filesystem::path(data != nullptr ? data : "") / "stereo/euroc_still/mav0";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "URBAN_NAV_DATA does not name a folder with stereo/euroc_still";
  const auto first = [&folder](const char* camera) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder / camera / "data"))
      files.push_back(entry.path());
    return cv::imread(std::min_element(files.begin(), files.end())->string(), cv::IMREAD_GRAYSCALE);
  };
  const StereoRectification pair = rectifyStereo(left(), right(), T_right_left(), "here");
  std::vector<std::uint8_t> left_pixels, right_pixels;
  RectifyMap(left(), pair.R_left, pair.camera.left).remap(view(first("cam0")), left_pixels);
  RectifyMap(right(), pair.R_right, pair.camera.left).remap(view(first("cam1")), right_pixels);
  const cv::Mat left_image(480, 752, CV_8U, left_pixels.data()), right_image(480, 752, CV_8U, right_pixels.data());
  Fast fast;
  std::vector<double> rows;
  for (const Corner& corner : fast.detect(view(left_image), 25, Fast::Suppression::LocalMaximum)) {
    const std::optional<double> row = matchedRow(left_image, right_image, corner.u, corner.v);
    if (row) rows.push_back(*row);
  }
  ASSERT_GT(rows.size(), 50U);
  std::nth_element(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(rows.size() / 2), rows.end());
  EXPECT_NEAR(rows[rows.size() / 2], 0.0, 0.3) << "px, over " << rows.size() << " corners";
}

TEST(Rectify, RejectsPairsThatAreSwappedOrDiverge) {
  EXPECT_THROW(rectifyStereo(right(), left(), T_right_left().inverse(), "here"), UserError);
  EXPECT_THROW(rectifyStereo(left(), right(), Pose(), "here"), UserError);
  const Pose apart(expSo3(Vector3d(0.0, 2.0, 0.0)), Vector3d(-0.1, 0.0, 0.0));
  EXPECT_THROW(rectifyStereo(left(), right(), apart, "here"), UserError);
}

}  // namespace
}  // namespace urban_nav_core
