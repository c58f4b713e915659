// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "urban_nav_core/geometry/se3.hpp"

namespace urban_nav_core::testing {

/// Perturbation and difference of vectors, numbers, rotations and poses: poses by boxPlus and boxMinus, rotations from
/// the left. Overload for other types in their own namespace.
inline Pose plus(const Pose& x, const Vector6d& d) { return boxPlus(x, d); }
inline Vector6d minus(const Pose& a, const Pose& b) { return boxMinus(a, b); }
inline Quaterniond plus(const Quaterniond& x, const Vector3d& d) { return expSo3(d) * x; }
inline Vector3d minus(const Quaterniond& a, const Quaterniond& b) { return logSo3(a * b.conjugate()); }
inline double plus(double x, const Eigen::Matrix<double, 1, 1>& d) { return x + d[0]; }
inline Eigen::Matrix<double, 1, 1> minus(double a, double b) { return Eigen::Matrix<double, 1, 1>(a - b); }
template <int N>
Eigen::Matrix<double, N, 1> plus(const Eigen::Matrix<double, N, 1>& x, const Eigen::Matrix<double, N, 1>& d) {
  return x + d;
}
template <int N>
Eigen::Matrix<double, N, 1> minus(const Eigen::Matrix<double, N, 1>& a, const Eigen::Matrix<double, N, 1>& b) {
  return a - b;
}

/// Returns d f / d x at x by Richardson extrapolation of central differences with the steps h and h / 2: error of order
/// h^4, so that a wrong term of 1e-8 is detected. `Rows` and `Columns` are the tangent sizes of f(x) and x.
template <int Rows, int Columns, typename X, typename Function>
Eigen::Matrix<double, Rows, Columns> numericJacobian(const Function& f, const X& x, double h = 1e-3) {
  Eigen::Matrix<double, Rows, Columns> J;
  const auto central = [&](int column, double step) -> Eigen::Matrix<double, Rows, 1> {
    Eigen::Matrix<double, Columns, 1> d = Eigen::Matrix<double, Columns, 1>::Zero();
    d[column] = step;
    const auto ahead = f(plus(x, d));
    d[column] = -step;
    const auto before = f(plus(x, d));
    return minus(ahead, before) / (2.0 * step);
  };
  for (int column = 0; column < Columns; ++column) {
    J.col(column) = (4.0 * central(column, 0.5 * h) - central(column, h)) / 3.0;
  }
  return J;
}

}  // namespace urban_nav_core::testing
