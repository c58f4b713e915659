// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>

#include "segway_drivers/bumblebee2/factory_calibration.hpp"

namespace segway_drivers {

namespace {

/// The four non-zero cubic basis functions at u, by de Boor's recurrence.
struct SplineBasis {
  std::array<double, 4> values{};
  int first = 0;  // index of the first
};

SplineBasis evaluateBasis(const std::vector<double>& knots, int count, double u) {
  int span = 3;
  while (span + 1 < count && u >= knots[static_cast<std::size_t>(span) + 1]) ++span;
  SplineBasis basis;
  basis.first = span - 3;
  basis.values[0] = 1.0;
  std::array<double, 4> left{}, right{};
  for (std::size_t degree = 1; degree < 4; ++degree) {
    left[degree] = u - knots[static_cast<std::size_t>(span) + 1 - degree];
    right[degree] = knots[static_cast<std::size_t>(span) + degree] - u;
    double carry = 0.0;
    for (std::size_t i = 0; i < degree; ++i) {
      const double width = right[i + 1] + left[degree - i];
      const double share = width > 0.0 ? basis.values[i] / width : 0.0;
      basis.values[i] = carry + right[i + 1] * share;
      carry = left[degree - i] * share;
    }
    basis.values[degree] = carry;
  }
  return basis;
}

}  // namespace

double CalibrationSurface::at(double x, double y) const {
  const SplineBasis bx = evaluateBasis(knots_x, count_x, std::clamp(x, 0.0, 1.0));
  const SplineBasis by = evaluateBasis(knots_y, count_y, std::clamp(y, 0.0, 1.0));
  double sum = 0.0;
  for (int i = 0; i < 4; ++i) {
    const double* row = coefficients.data() + (bx.first + i) * count_y + by.first;
    for (int j = 0; j < 4; ++j)
      sum += bx.values[static_cast<std::size_t>(i)] * by.values[static_cast<std::size_t>(j)] * row[j];
  }
  return sum;
}

RectifyingMap makeRectifyingMap(const ImagerCalibration& imager, cv::Size size) {
  RectifyingMap map{cv::Mat(size, CV_32F), cv::Mat(size, CV_32F)};
  for (int v = 0; v < size.height; ++v) {
    for (int u = 0; u < size.width; ++u) {
      const double x = static_cast<double>(u) / size.width, y = static_cast<double>(v) / size.height;
      map.x.at<float>(v, u) = static_cast<float>(size.width * imager.forward_x.at(x, y));
      map.y.at<float>(v, u) = static_cast<float>(size.height * imager.forward_y.at(x, y));
    }
  }
  return map;
}

}  // namespace segway_drivers
