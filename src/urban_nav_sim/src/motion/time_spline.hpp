// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace urban_nav_sim {

using Vector6 = Eigen::Matrix<double, 6, 1>;

/// Six functions of time as uniform B-splines of degree five: four times continuously differentiable. Immutable, so
/// thread-safe.
class TimeSpline {
 public:
  struct Value {
    Vector6 value, rate, change;  ///< of the functions; first and second derivatives by s
  };

  /// Control point i belongs to the time `first + i * step` (s). The curve does not interpolate the points: it is their
  /// polygon smoothed over six steps (and equals it where straight). At least six points.
  TimeSpline(double first, double step, std::vector<Vector6> control);

  double begin() const { return first_ + 2.0 * step_; }
  double end() const { return first_ + static_cast<double>(control_.size() - 3) * step_; }
  /// Extrapolates the outermost polynomial beyond begin() ... end().
  Value at(double t) const;

 private:
  double first_, step_;
  std::vector<Vector6> control_;
};

}  // namespace urban_nav_sim
