// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace swf_vo {

/// Difference of a measured from a predicted pixel coordinate of one landmark.
struct PixelDifference {
  double px = 0.0;
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();  ///< derivative by the two parameters
  std::size_t cell = 0;                             ///< of the image, below kFitCells
};

constexpr int kFitColumns = 6, kFitRows = 4;  // cells of the image
constexpr std::size_t kFitCells = kFitColumns * kFitRows;

/// Returns the cell of a pixel in an image of this size.
std::size_t fitCell(const Eigen::Vector2d& pixel, int width, int height);

struct RobustFit {
  bool found = false;
  Eigen::Vector2d value = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  int landmarks = 0;  ///< without outliers
};

/// Fits px = slope . value by least squares with Huber's weights; differences further than six standard deviations from
/// the median are left out, and removed from `differences`. The standard deviation of the rest is that about the fit.
/// The covariance is the larger of that of independent errors and that of a sandwich over cells of the image, whose
/// landmarks share errors (Liang and Zeger 1986). Not found with fewer than 12 landmarks. `scratch`: keeps its
/// capacity.
RobustFit fitRobustly(std::vector<PixelDifference>& differences, std::vector<double>& scratch);

}  // namespace swf_vo
