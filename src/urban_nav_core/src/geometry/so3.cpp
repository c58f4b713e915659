// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/geometry/so3.hpp"

#include <cmath>

#include "series.hpp"

namespace urban_nav_core {

Matrix3d skew(const Vector3d& a) {
  Matrix3d m;
  m << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return m;
}

Quaterniond expSo3(const Vector3d& phi) {
  const double half = 0.5 * phi.norm();
  const Vector3d v = 0.5 * series::sinc(half) * phi;
  return Quaterniond(std::cos(half), v.x(), v.y(), v.z());
}

Vector3d logSo3(const Quaterniond& q) {
  double w = q.w();
  Vector3d v = q.vec();
  // q and -q are the same rotation. At exactly half a turn both axes are valid: the sign of the first non-zero
  // coordinate selects one.
  const auto pointsBack = [&v] {
    for (int i = 0; i < 3; ++i) {
      if (v[i] != 0.0) return v[i] < 0.0;
    }
    return false;
  };
  if (w < 0.0 || (w == 0.0 && pointsBack())) {
    w = -w;
    v = -v;
  }
  const double n = v.norm();
  if (n < 1e-8 * w) return (2.0 / w) * v;  // the next term, n^2 / (3 w^2), is below machine precision
  return (2.0 * std::atan2(n, w) / n) * v;
}

Matrix3d leftJacobianSo3(const Vector3d& phi) {
  const double angle = phi.norm();
  const double half_sinc = series::sinc(0.5 * angle);
  const Matrix3d S = skew(phi);
  return Matrix3d::Identity() + 0.5 * half_sinc * half_sinc * S + series::sineRest(angle) * (S * S);
}

Matrix3d leftJacobianInverseSo3(const Vector3d& phi) {
  const Matrix3d S = skew(phi);
  return Matrix3d::Identity() - 0.5 * S + series::cotangentRest(phi.norm()) * (S * S);
}

}  // namespace urban_nav_core
