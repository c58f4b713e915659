// SPDX-License-Identifier: BSD-3-Clause
#include "moments.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace laser_odometry {
namespace {

constexpr double kLeastPoints = 6.0;
constexpr double kLeastRatio = 10.0;  // ratio of variances in and across the plane
// Variance of errors common to the beams of one ring, m^2: range and angle. They tilt a plane of few rings, independent
// of the number of points.
constexpr double kLineVariance = 0.005 * 0.005;
constexpr double kReachedSigmas = 2.5;

}  // namespace

void Moments::add(const Moments& other, const Vector3d& shift) {
  const Vector3d& s = other.sum;
  const double n = other.count;
  outer[0] += other.outer[0] + 2.0 * shift.x() * s.x() + n * shift.x() * shift.x();
  outer[1] += other.outer[1] + shift.x() * s.y() + shift.y() * s.x() + n * shift.x() * shift.y();
  outer[2] += other.outer[2] + shift.x() * s.z() + shift.z() * s.x() + n * shift.x() * shift.z();
  outer[3] += other.outer[3] + 2.0 * shift.y() * s.y() + n * shift.y() * shift.y();
  outer[4] += other.outer[4] + shift.y() * s.z() + shift.z() * s.y() + n * shift.y() * shift.z();
  outer[5] += other.outer[5] + 2.0 * shift.z() * s.z() + n * shift.z() * shift.z();
  sum += s + n * shift;
  count += n;
}

void Moments::add(double n, const Vector3d& mean, const Matrix3d& covariance) {
  count += n;
  sum += n * mean;
  const Matrix3d squares = n * (covariance + mean * mean.transpose());
  outer[0] += squares(0, 0);
  outer[1] += squares(0, 1);
  outer[2] += squares(0, 2);
  outer[3] += squares(1, 1);
  outer[4] += squares(1, 2);
  outer[5] += squares(2, 2);
}

void Moments::scale(double factor) {
  count *= factor;
  sum *= factor;
  outer *= factor;
}

Matrix3d Moments::covariance() const {
  const Vector3d m = mean();
  Matrix3d C;
  C << outer[0], outer[1], outer[2], outer[1], outer[3], outer[4], outer[2], outer[4], outer[5];
  return C / count - m * m.transpose();
}

bool isOutside(const Plane& plane, const Vector3d& p) {
  const Vector3d d = p - plane.mean;
  const double across = d.dot(plane.narrow), along = d.dot(plane.normal.cross(plane.narrow));
  return across * across > kReachedSigmas * kReachedSigmas * plane.width ||
         along * along > kReachedSigmas * kReachedSigmas * plane.length;
}

Plane fitPlane(const Moments& moments, const Vector3d& origin) {
  Plane plane;
  if (moments.count < kLeastPoints) return plane;
  Eigen::SelfAdjointEigenSolver<Matrix3d> solver;
  solver.computeDirect(moments.covariance());
  plane.variance = std::max(0.0, solver.eigenvalues()[0]);
  plane.width = solver.eigenvalues()[1];
  plane.length = solver.eigenvalues()[2];
  plane.narrow = solver.eigenvectors().col(1);
  plane.usable = plane.width > kLeastRatio * plane.variance && plane.width > 0.0;
  if (!plane.usable) return plane;
  plane.normal_variance = ((plane.variance + kBeamVariance) / moments.count + kLineVariance) / plane.width;
  plane.normal = solver.eigenvectors().col(0);
  plane.mean = origin + moments.mean();
  return plane;
}

Plane fitWall(const Moments& moments, const Vector3d& origin) {
  Plane plane;
  if (moments.count < kLeastPoints) return plane;
  const Matrix3d C = moments.covariance();
  const double half = 0.5 * (C(0, 0) - C(1, 1)), mean = 0.5 * (C(0, 0) + C(1, 1));
  const double spread = std::hypot(half, C(0, 1));
  const double angle = 0.5 * std::atan2(C(0, 1), half);  // of the wall
  plane.variance = std::max(0.0, mean - spread);
  plane.width = plane.length = mean + spread;
  plane.narrow = Vector3d(std::cos(angle), std::sin(angle), 0.0);
  plane.usable = plane.width > kLeastRatio * plane.variance && plane.width > 0.0;
  if (!plane.usable) return plane;
  // Errors of the beams are independent, unlike those of a line of a 3D LiDAR, which has a common error of its ring.
  plane.normal_variance = (plane.variance + kBeamVariance) / (moments.count * plane.width);
  plane.normal = Vector3d(-plane.narrow.y(), plane.narrow.x(), 0.0);
  plane.mean = origin + moments.mean();
  return plane;
}

}  // namespace laser_odometry
