// SPDX-License-Identifier: BSD-3-Clause
#include "front_end/disparity_step.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

namespace swf_vo {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using urban_nav_core::Pose;
using urban_nav_core::StereoCamera;

namespace {

constexpr std::size_t kLeastMatches = 12;
constexpr int kStepIterations = 8;
constexpr int kColumns = 6, kRows = 4;  // cells of the image
constexpr double kStepHuber = 1.5;      // standard deviations
constexpr double kStepOutlier = 6.0;    // standard deviations of the middle half
constexpr double kLeastScatterPx = 0.02;

using Difference = DisparityStepMeter::Difference;

/// Returns the median; the order of the values changes.
double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void listDifferences(const StereoCamera& camera, const Pose& T_camera_odom, const std::vector<Match>& matches,
                     std::vector<Difference>& differences) {
  differences.clear();
  for (const Match& match : matches) {
    if (!match.left.found || !match.right.found || match.track->seen < 2) continue;
    const Eigen::Vector3d p = T_camera_odom.q() * match.p_odom.head<3>() + T_camera_odom.t() * match.p_odom.w();
    if (!(p.z() > 1e-6)) continue;
    const double disparity = camera.left.fx * camera.baseline * match.p_odom.w() / p.z();
    const double u = match.left.pixel.x() / camera.left.width, v = match.left.pixel.y() / camera.left.height;
    Difference difference;
    difference.px = match.left.pixel.x() - match.right.pixel.x() - camera.disparity_offset - disparity;
    const double x = (match.left.pixel.x() - camera.left.cx) / camera.left.fx;
    difference.slope = {1.0 + x * x, disparity * disparity / (camera.left.fx * camera.baseline)};
    difference.cell = static_cast<std::size_t>(std::clamp(static_cast<int>(v * kRows), 0, kRows - 1) * kColumns +
                                               std::clamp(static_cast<int>(u * kColumns), 0, kColumns - 1));
    differences.push_back(difference);
  }
}

/// Removes outliers with respect to the median, and returns the scatter of the others, px.
double removeOutliers(std::vector<Difference>& differences, std::vector<double>& values) {
  values.clear();
  for (const Difference& difference : differences) values.push_back(difference.px);
  const double middle = median(values);
  for (double& value : values) value = std::abs(value - middle);
  const double scatter = std::max(kLeastScatterPx, 1.4826 * median(values));
  differences.erase(
      std::remove_if(differences.begin(), differences.end(),
                     [&](const Difference& each) { return !(std::abs(each.px - middle) < kStepOutlier * scatter); }),
      differences.end());
  return scatter;
}

}  // namespace

DisparityStep DisparityStepMeter::measure(const StereoCamera& camera, const Pose& T_camera_odom,
                                          const std::vector<Match>& matches) {
  std::vector<Difference>& differences = differences_;
  differences.reserve(matches.capacity());
  values_.reserve(matches.capacity());
  listDifferences(camera, T_camera_odom, matches, differences);
  if (differences.size() < kLeastMatches) return {};
  const double scatter = removeOutliers(differences, values_);
  if (differences.size() < kLeastMatches) return {};
  Vector2d x = Vector2d::Zero();
  Matrix2d information = Matrix2d::Zero();
  std::array<Vector2d, kColumns * kRows> scores;
  for (int i = 0; i < kStepIterations; ++i) {
    information.setZero();
    Vector2d right = Vector2d::Zero();
    scores.fill(Vector2d::Zero());
    for (const Difference& each : differences) {
      const double error = each.px - each.slope.dot(x);
      const double weight = std::min(1.0, kStepHuber * scatter / std::max(1e-12, std::abs(error)));
      information += weight * each.slope * each.slope.transpose();
      right += weight * each.px * each.slope;
      scores[each.cell] += weight * error * each.slope;
    }
    information(1, 1) += 1e-9;  // all points at infinity
    const Vector2d next = information.inverse() * right;
    if (!next.allFinite()) return {};
    x = next;
  }
  Matrix2d scatter_of_scores = Matrix2d::Zero();
  for (const Vector2d& score : scores) scatter_of_scores += score * score.transpose();
  const Matrix2d inverse = information.inverse();
  const double by_cells = (inverse * scatter_of_scores * inverse)(0, 0);
  const double independent = scatter * scatter * inverse(0, 0);
  DisparityStep step;
  step.px = x[0];
  step.sigma_px = std::sqrt(std::max(by_cells, independent));
  step.landmarks = static_cast<int>(differences.size());
  return step;
}

}  // namespace swf_vo
