// SPDX-License-Identifier: BSD-3-Clause
#include "opencv_pnp.hpp"

#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>
#include <vector>

namespace urban_nav_registration::bench {

using urban_nav_core::ImageView;
using urban_nav_core::Pose;
using urban_nav_core::StereoCamera;
using urban_nav_core::StereoPair;

namespace {

constexpr int kFeatures = 500, kLeastInliers = 50;
constexpr float kRatio = 0.8F, kInlierPx = 2.0F;
constexpr int kDisparities = 64;

cv::Mat toMat(const ImageView& image) {
  return {image.height, image.width, CV_8U, const_cast<std::uint8_t*>(image.data),
          static_cast<std::size_t>(image.stride)};
}

cv::Ptr<cv::Feature2D> makeDetector(Feature feature) {
#if CV_VERSION_MAJOR > 4 || (CV_VERSION_MAJOR == 4 && CV_VERSION_MINOR >= 4)
  if (feature == Feature::Sift) return cv::SIFT::create(kFeatures);
#endif
  return cv::ORB::create(kFeatures);
}

}  // namespace

std::optional<Pose> poseByOpenCv(Feature feature, const StereoCamera& camera, const StereoPair& a,
                                 const StereoPair& b) {
  if (a.left.empty() || a.right.empty() || b.left.empty()) return std::nullopt;
  const cv::Mat left = toMat(a.left), right = toMat(a.right), other = toMat(b.left);
  const auto detector = makeDetector(feature);
  std::vector<cv::KeyPoint> in_a, in_b;
  cv::Mat of_a, of_b, disparity;
  detector->detectAndCompute(left, cv::noArray(), in_a, of_a);
  detector->detectAndCompute(other, cv::noArray(), in_b, of_b);
  if (in_a.size() < 2 || in_b.size() < 2) return std::nullopt;
  cv::StereoSGBM::create(0, kDisparities, 5, 200, 800, 1, 0, 10, 100, 2)->compute(left, right, disparity);
  std::vector<std::vector<cv::DMatch>> matches;
  cv::BFMatcher(feature == Feature::Sift ? cv::NORM_L2 : cv::NORM_HAMMING).knnMatch(of_b, of_a, matches, 2);
  std::vector<cv::Point3d> points;
  std::vector<cv::Point2d> pixels;
  for (const auto& match : matches) {
    if (match.size() < 2 || match[0].distance > kRatio * match[1].distance) continue;
    const cv::Point2f at = in_a[static_cast<std::size_t>(match[0].trainIdx)].pt;
    const double d = disparity.at<std::int16_t>(cvRound(at.y), cvRound(at.x)) / 16.0;
    if (d <= 0.5) continue;
    const auto p =
        camera.triangulate({static_cast<double>(at.x), static_cast<double>(at.y), static_cast<double>(at.x) - d});
    if (!p) continue;
    points.emplace_back(p->x(), p->y(), p->z());
    pixels.emplace_back(in_b[static_cast<std::size_t>(match[0].queryIdx)].pt);
  }
  if (points.size() < 6) return std::nullopt;
  const cv::Matx33d K(camera.left.fx, 0.0, camera.left.cx, 0.0, camera.left.fy, camera.left.cy, 0.0, 0.0, 1.0);
  cv::Vec3d turn, t;
  std::vector<int> inliers;
  cv::setRNGSeed(1);
  if (!cv::solvePnPRansac(points, pixels, K, cv::noArray(), turn, t, false, 500, kInlierPx, 0.999, inliers,
                          cv::SOLVEPNP_P3P) ||
      static_cast<int>(inliers.size()) < kLeastInliers)
    return std::nullopt;
  std::vector<cv::Point3d> kept_points;
  std::vector<cv::Point2d> kept_pixels, projected;
  for (const int i : inliers) {
    kept_points.push_back(points[static_cast<std::size_t>(i)]);
    kept_pixels.push_back(pixels[static_cast<std::size_t>(i)]);
  }
  cv::solvePnPRefineLM(kept_points, kept_pixels, K, cv::noArray(), turn, t);
  cv::projectPoints(kept_points, turn, t, K, cv::noArray(), projected);
  int agreeing = 0;
  for (std::size_t i = 0; i < projected.size(); ++i)
    if (cv::norm(projected[i] - kept_pixels[i]) < static_cast<double>(kInlierPx)) ++agreeing;
  if (agreeing < kLeastInliers) return std::nullopt;
  const Pose T_b_a(urban_nav_core::expSo3({turn[0], turn[1], turn[2]}), {t[0], t[1], t[2]});
  return T_b_a.inverse();
}

}  // namespace urban_nav_registration::bench
