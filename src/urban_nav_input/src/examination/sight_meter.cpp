// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/examination/sight_meter.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <random>

#include "urban_nav_ros/image_features.hpp"

namespace urban_nav_input {

using urban_nav_core::Matrix3d;
using urban_nav_core::Pose;
using urban_nav_core::StereoCamera;
using urban_nav_core::StereoPair;
using urban_nav_core::Vector3d;
using urban_nav_ros::ImageFeatures;

namespace {

constexpr float kSightRows = 1.5F;       // px between the rows of a match
constexpr double kLeastDisparity = 3.0;  // px: beyond, depth is too uncertain for motion
constexpr int kLeastInliers = 25;
constexpr float kReprojection = 2.0F;  // px
constexpr int kPnpTrials = 200;
constexpr double kBelow = 0.15;           // m below the camera, for points that may be ground
constexpr double kFarthestGround = 12.0;  // m
constexpr std::size_t kLeastGround = 40;  // points
constexpr double kGroundShare = 0.5;      // share of the points below the camera
constexpr int kGroundTrials = 200;
constexpr double kSteepest = 0.5;      // cosine of 60 deg
constexpr double kGroundSpread = 0.3;  // least standard deviation of the ground points along the shorter axis, m

/// Returns the point of each left feature in the left optical frame; empty for features without a stereo match.
std::vector<std::optional<Vector3d>> triangulateFeatures(const StereoCamera& camera, const ImageFeatures& left,
                                                         const ImageFeatures& right) {
  std::vector<std::optional<Vector3d>> points(left.points.size());
  for (const cv::DMatch& match : urban_nav_ros::matchFeatures(left, right)) {
    const cv::Point2f a = left.points[static_cast<std::size_t>(match.queryIdx)].pt,
                      b = right.points[static_cast<std::size_t>(match.trainIdx)].pt;
    if (std::abs(a.y - b.y) > kSightRows || a.x - b.x - camera.disparity_offset < kLeastDisparity) continue;
    points[static_cast<std::size_t>(match.queryIdx)] = camera.triangulate({a.x, a.y, b.x});
  }
  return points;
}

/// Returns T_before_after of the camera; nullopt if too few points agree.
std::optional<Pose> measureMotion(const StereoCamera& camera, const ImageFeatures& before,
                                  const std::vector<std::optional<Vector3d>>& points, const ImageFeatures& after) {
  std::vector<cv::Point3d> places;
  std::vector<cv::Point2d> pixels;
  for (const cv::DMatch& match : urban_nav_ros::matchFeatures(before, after)) {
    const std::optional<Vector3d>& point = points[static_cast<std::size_t>(match.queryIdx)];
    if (!point) continue;
    places.emplace_back(point->x(), point->y(), point->z());
    pixels.emplace_back(after.points[static_cast<std::size_t>(match.trainIdx)].pt);
  }
  if (static_cast<int>(places.size()) < kLeastInliers) return std::nullopt;
  const urban_nav_core::Pinhole& c = camera.left;
  const cv::Matx33d K(c.fx, 0.0, c.cx, 0.0, c.fy, c.cy, 0.0, 0.0, 1.0);
  cv::Vec3d turn(0.0, 0.0, 0.0), shift(0.0, 0.0, 0.0);
  std::vector<int> inliers;
  if (!cv::solvePnPRansac(places, pixels, K, cv::noArray(), turn, shift, true, kPnpTrials, kReprojection, 0.99,
                          inliers))
    return std::nullopt;
  if (static_cast<int>(inliers.size()) < kLeastInliers || 2 * inliers.size() < places.size()) return std::nullopt;
  const Vector3d rotation(turn[0], turn[1], turn[2]), translation(shift[0], shift[1], shift[2]);
  if (!rotation.allFinite() || !translation.allFinite()) return std::nullopt;
  const double angle = rotation.norm();
  const urban_nav_core::Quaterniond q(angle > 0.0 ? Eigen::AngleAxisd(angle, rotation / angle)
                                                  : Eigen::AngleAxisd::Identity());
  return Pose(q, translation).inverse();
}

}  // namespace

std::optional<SeenGround> findGround(const std::vector<Vector3d>& points) {
  std::vector<Vector3d> low;
  for (const Vector3d& point : points)
    if (point.z() < -kBelow && point.norm() < kFarthestGround) low.push_back(point);
  if (low.size() < kLeastGround) return std::nullopt;
  const auto tolerance = [](const Vector3d& point) { return 0.03 + 0.02 * point.norm(); };  // m, error of stereo depth
  std::mt19937 random(1);
  const auto draw = [&]() -> const Vector3d& { return low[random() % low.size()]; };
  std::size_t most = 0;
  Vector3d normal = Vector3d::UnitZ(), on_plane = Vector3d::Zero();
  for (int trial = 0; trial < kGroundTrials; ++trial) {
    const Vector3d a = draw(), b = draw(), c = draw();
    const Vector3d cross = (b - a).cross(c - a);
    if (cross.norm() < 0.02) continue;
    const Vector3d n = cross.normalized() * (cross.z() < 0.0 ? -1.0 : 1.0);
    if (n.z() < kSteepest) continue;
    const auto on = static_cast<std::size_t>(std::count_if(
        low.begin(), low.end(), [&](const Vector3d& point) { return std::abs(n.dot(point - a)) < tolerance(point); }));
    if (on > most) most = on, normal = n, on_plane = a;
  }
  if (most < kLeastGround || static_cast<double>(most) < kGroundShare * static_cast<double>(low.size()))
    return std::nullopt;
  Vector3d mean = Vector3d::Zero();
  Matrix3d squares = Matrix3d::Zero();
  double count = 0.0;
  for (const Vector3d& point : low) {
    if (std::abs(normal.dot(point - on_plane)) >= tolerance(point)) continue;
    mean += point;
    squares += point * point.transpose();
    count += 1.0;
  }
  mean /= count;
  const Eigen::SelfAdjointEigenSolver<Matrix3d> axes(squares / count - mean * mean.transpose());
  if (!(std::sqrt(std::max(0.0, axes.eigenvalues()(1))) > kGroundSpread)) return std::nullopt;
  const Vector3d fitted = axes.eigenvectors().col(0), up = fitted.z() < 0.0 ? Vector3d(-fitted) : fitted;
  return SeenGround{up, -up.dot(mean)};
}

void SightMeter::add(const StereoPair& before, const StereoPair& after) {
  if (before.left.empty() || before.right.empty()) return;
  const ImageFeatures left = urban_nav_ros::extractFeatures(before.left);
  const std::vector<std::optional<Vector3d>> points =
      triangulateFeatures(camera_, left, urban_nav_ros::extractFeatures(before.right));
  std::vector<Vector3d> in_base;
  for (const std::optional<Vector3d>& point : points)
    if (point) in_base.push_back(T_base_camera_.R() * *point);
  if (const std::optional<SeenGround> ground = findGround(in_base)) sight_.grounds.push_back(*ground);
  if (after.left.empty() || after.stamp <= before.stamp) return;
  const auto T_before_after = measureMotion(camera_, left, points, urban_nav_ros::extractFeatures(after.left));
  if (!T_before_after) return;
  sight_.motions.push_back({before.stamp, after.stamp, T_base_camera_ * *T_before_after * T_base_camera_.inverse()});
}

}  // namespace urban_nav_input
