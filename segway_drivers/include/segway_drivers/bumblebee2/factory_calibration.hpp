// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace segway_drivers {

/// Tensor product of clamped cubic B-splines over the unit square, for one coordinate of a mapping.
struct CalibrationSurface {
  std::vector<double> knots_x, knots_y;
  int count_x = 0, count_y = 0;
  std::vector<double> coefficients;  ///< x is the outer index

  /// Returns the value at a point, clamped to the unit square.
  double at(double x, double y) const;
};

/// Mappings of one imager in coordinates normalised by width and height. Forward: rectified to raw.
struct ImagerCalibration {
  CalibrationSurface forward_x, forward_y, inverse_x, inverse_y;
};

/// Calibration stored in a Bumblebee2 ("Triclops" file): a rectified pair and the mapping of each imager.
struct FactoryCalibration {
  double fx = 0.0, fy = 0.0, cx = 0.0, cy = 0.0;  ///< of the rectified pair, in units of width and height
  double baseline = 0.0;                          ///< m
  ImagerCalibration left, right;
};

/// Parses the text. Throws UserError with `name` and the missing or malformed entry.
FactoryCalibration parseFactoryCalibration(const std::string& text, const std::string& name);

/// Maps of cv::remap from raw to rectified images of one size.
struct RectifyingMap {
  cv::Mat x, y;  // float, px in the raw image
};
RectifyingMap makeRectifyingMap(const ImagerCalibration& imager, cv::Size size);

}  // namespace segway_drivers
