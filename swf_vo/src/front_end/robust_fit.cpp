// SPDX-License-Identifier: BSD-3-Clause
#include "front_end/robust_fit.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

namespace swf_vo {

using Eigen::Matrix2d;
using Eigen::Vector2d;

namespace {

constexpr std::size_t kLeastMatches = 12;
constexpr int kFitIterations = 8;
constexpr double kFitHuber = 1.5;    // standard deviations
constexpr double kFitOutlier = 6.0;  // standard deviations of the middle half
constexpr double kLeastScatterPx = 0.02;
constexpr double kSigmasOfMedian = 1.4826;  // standard deviation of a normal variable over its median magnitude

/// Returns the median; the order of the values changes.
double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Removes what is far from the median, and returns the scatter of the rest, px.
double removeOutliers(std::vector<PixelDifference>& differences, std::vector<double>& values) {
  values.clear();
  for (const PixelDifference& difference : differences) values.push_back(difference.px);
  const double middle = median(values);
  for (double& value : values) value = std::abs(value - middle);
  const double scatter = std::max(kLeastScatterPx, kSigmasOfMedian * median(values));
  differences.erase(std::remove_if(differences.begin(), differences.end(),
                                   [&](const PixelDifference& each) {
                                     return !(std::abs(each.px - middle) < kFitOutlier * scatter);
                                   }),
                    differences.end());
  return scatter;
}

/// Returns the scatter of the differences from the fit, px.
double scatterAbout(const Vector2d& x, const std::vector<PixelDifference>& differences, std::vector<double>& values) {
  values.clear();
  for (const PixelDifference& each : differences) values.push_back(std::abs(each.px - each.slope.dot(x)));
  return std::max(kLeastScatterPx, kSigmasOfMedian * median(values));
}

}  // namespace

std::size_t fitCell(const Vector2d& pixel, int width, int height) {
  const double u = pixel.x() / width, v = pixel.y() / height;
  return static_cast<std::size_t>(std::clamp(static_cast<int>(v * kFitRows), 0, kFitRows - 1) * kFitColumns +
                                  std::clamp(static_cast<int>(u * kFitColumns), 0, kFitColumns - 1));
}

RobustFit fitRobustly(std::vector<PixelDifference>& differences, std::vector<double>& scratch) {
  RobustFit fit;
  if (differences.size() < kLeastMatches) return fit;
  double scatter = removeOutliers(differences, scratch);
  if (differences.size() < kLeastMatches) return fit;
  Vector2d x = Vector2d::Zero();
  Matrix2d information = Matrix2d::Zero();
  std::array<Vector2d, kFitCells> scores;
  for (int i = 0; i < kFitIterations; ++i) {
    information.setZero();
    Vector2d right = Vector2d::Zero();
    scores.fill(Vector2d::Zero());
    for (const PixelDifference& each : differences) {
      const double error = each.px - each.slope.dot(x);
      const double weight = std::min(1.0, kFitHuber * scatter / std::max(1e-12, std::abs(error)));
      information += weight * each.slope * each.slope.transpose();
      right += weight * each.px * each.slope;
      scores[each.cell] += weight * error * each.slope;
    }
    information(1, 1) += 1e-9;  // a second parameter on which nothing depends
    const Vector2d next = information.inverse() * right;
    if (!next.allFinite()) return fit;
    x = next;
    if (i + 1 < kFitIterations) scatter = scatterAbout(x, differences, scratch);
  }
  Matrix2d scatter_of_scores = Matrix2d::Zero();
  for (const Vector2d& score : scores) scatter_of_scores += score * score.transpose();
  const Matrix2d inverse = information.inverse();
  const Matrix2d by_cells = inverse * scatter_of_scores * inverse, independent = scatter * scatter * inverse;
  fit.found = true;
  fit.value = x;
  fit.covariance = by_cells;
  for (int i = 0; i < 2; ++i) fit.covariance(i, i) = std::max(by_cells(i, i), independent(i, i));
  fit.landmarks = static_cast<int>(differences.size());
  return fit;
}

}  // namespace swf_vo
