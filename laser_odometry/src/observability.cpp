// SPDX-License-Identifier: BSD-3-Clause
#include "observability.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/geometry/small_matrices.hpp"

namespace laser_odometry {
namespace {

// Sine of the minimum angle between a plane and the displacement that it measures: 7 deg, the unevenness of a road; and
// the minimum number of standard deviations of the normal.
constexpr double kLeastSine = 0.12;
constexpr double kLeastSigmas = 4.0;
// Mean square of the rows along a direction that is certainly constrained, given this number of rows: rows below
// kLeastSine could not add up to it.
constexpr double kSurelyObserved = 0.1;
constexpr std::size_t kManyRows = 200;
// Minimum effective number of patches of a constrained direction, and its share of all.
constexpr double kLeastPatches = 6.0;
constexpr double kLeastShare = 0.002;
constexpr int kInPlane[] = {0, 1, 5};  // coordinates of planar motion: x, y, yaw

using urban_nav_core::SmallEigen;

/// Returns the scaling (1, 1, 1, 1/lever ...).
Vector6d scaling(double lever) {
  Vector6d s;
  s << 1.0, 1.0, 1.0, 1.0 / lever, 1.0 / lever, 1.0 / lever;
  return s;
}

/// Returns the projector onto the observed directions.
Matrix6d projectorOntoObserved(const FreeSubspace& free) {
  Matrix6d P = Matrix6d::Identity();
  for (const Vector6d& v : free.directions) P -= v * v.transpose();
  return free.space == MotionSpace::Planar ? toPlanar(P) : P;
}

/// Returns the projector onto the estimated coordinates.
Matrix6d projectorOntoSpace(MotionSpace space) {
  return space == MotionSpace::Planar ? toPlanar(Matrix6d(Matrix6d::Identity())) : Matrix6d(Matrix6d::Identity());
}

/// A direction with its mean square over the rows.
struct Candidate {
  double value = 0.0;
  Vector6d direction = Vector6d::Zero();
};

/// Returns the eigenvectors of a matrix within the space, weakest first.
std::vector<Candidate> findCandidates(const Matrix6d& A, MotionSpace space) {
  std::vector<Candidate> candidates;
  if (space == MotionSpace::Spatial) {
    const SmallEigen<6> eigen = urban_nav_core::smallEigen<6>(A);
    for (int i = 0; i < 6; ++i) candidates.push_back({eigen.values[i], eigen.vectors.col(i)});
    return candidates;
  }
  Eigen::Matrix3d part;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) part(i, k) = A(kInPlane[i], kInPlane[k]);
  const SmallEigen<3> eigen = urban_nav_core::smallEigen<3>(part);
  for (int i = 0; i < 3; ++i) {
    Candidate candidate{eigen.values[i], Vector6d::Zero()};
    for (int k = 0; k < 3; ++k) candidate.direction[kInPlane[k]] = eigen.vectors(k, i);
    candidates.push_back(candidate);
  }
  return candidates;
}

/// Returns the inverse of the scaled information on the observed directions, zero on the free ones.
Matrix6d inverseOnObserved(const Matrix6d& H, const FreeSubspace& free) {
  const Vector6d s = scaling(free.lever);
  Matrix6d A = s.asDiagonal() * H * s.asDiagonal();
  const Matrix6d P = projectorOntoObserved(free);
  A = P * A * P;
  const double top = A.trace();
  if (!(top > 0.0)) return Matrix6d::Zero();
  // Free directions get the mean information, which the projector removes.
  const Matrix6d filled = A + top / 6.0 * (Matrix6d::Identity() - P) + 1e-12 * top * Matrix6d::Identity();
  const urban_nav_core::SmallCholesky<6> factor(filled);
  if (!factor.succeeded()) return Matrix6d::Zero();
  const Matrix6d inverse = P * factor.inverse() * P;
  return 0.5 * (inverse + inverse.transpose());
}

}  // namespace

bool FreeSubspace::leavesPositionFree() const {
  return std::any_of(directions.begin(), directions.end(),
                     [](const Vector6d& v) { return v.head<3>().norm() > v.tail<3>().norm(); });
}

Vector6d FreeSubspace::scaled(const Vector6d& d) const {
  Vector6d s = d;
  s.tail<3>() *= lever;
  return s;
}

Vector6d FreeSubspace::unscaled(const Vector6d& d) const {
  Vector6d s = d;
  s.tail<3>() /= lever;
  return s;
}

Vector6d PlaneRow::jacobian() const {
  Vector6d J;
  J << normal, lever.cross(normal);
  return J;
}

FreeSubspace findFreeSubspace(const std::vector<PlaneRow>& rows, MotionSpace space) {
  FreeSubspace free;
  free.space = space;
  double total = 0.0, levers = 0.0;
  for (const PlaneRow& row : rows) {
    total += row.weight;
    // In a round room the yaw has no lever but noise of the normals, by which it must not be scaled.
    levers += row.weight *
              (space == MotionSpace::Planar ? row.lever : Eigen::Vector3d(row.lever.cross(row.normal))).squaredNorm();
  }
  if (!(total > 0.0)) {
    for (int i = 0; i < 6; ++i)
      if (projectorOntoSpace(space)(i, i) > 0.0) free.directions.push_back(Vector6d::Unit(i));
    free.evidence.assign(free.directions.size(), 0.0);
    return free;
  }
  free.lever = std::max(1e-3, std::sqrt(levers / total));
  const Vector6d s = scaling(free.lever);
  Matrix6d A = Matrix6d::Zero();
  for (const PlaneRow& row : rows) {
    const Vector6d j = s.cwiseProduct(row.jacobian());
    A.noalias() += row.weight * j * j.transpose();
  }
  // Weights relative to the mean: a patch of average weight counts as one.
  const double usual = total / static_cast<double>(rows.size());
  const double fewest = std::max(kLeastPatches, kLeastShare * static_cast<double>(rows.size()));
  for (const auto& [value, direction] : findCandidates(A, space)) {
    double patches = 0.0, squares = 0.0;
    if (value > kSurelyObserved * total && rows.size() > kManyRows) {
      free.evidence.push_back(value / usual);
      continue;
    }
    const Eigen::Vector3d shift = direction.head<3>(), turn = direction.tail<3>() / free.lever;
    for (const PlaneRow& row : rows) {
      const Eigen::Vector3d displacement = shift + turn.cross(row.lever);
      squares += row.weight * displacement.squaredNorm();
      const double across = displacement.dot(row.normal);
      const double least = std::max(kLeastSine, kLeastSigmas * row.normal_sigma) * displacement.norm();
      if (std::abs(across) > least) patches += std::min(1.0, row.weight / usual) * across * across;
    }
    // Relative to the mean displacement: a roll displaces the near walls of a long corridor only slightly, but all of
    // them.
    if (squares > 0.0) patches *= total / squares;
    free.evidence.push_back(patches);
    if (patches < fewest) free.directions.push_back(direction);
  }
  return free;
}

Vector6d solveObserved(const Matrix6d& H, const Vector6d& g, const FreeSubspace& free, const Vector6d& along_free) {
  const Vector6d s = scaling(free.lever);
  Vector6d kept = Vector6d::Zero();
  for (const Vector6d& v : free.directions) kept += v * v.dot(free.scaled(along_free));
  const Vector6d rest = s.cwiseProduct(g - H * s.cwiseProduct(kept));
  return s.cwiseProduct(inverseOnObserved(H, free) * rest + kept);
}

Matrix6d covarianceOfObserved(const Matrix6d& H, const FreeSubspace& free, const Matrix6d& prior) {
  const Vector6d s = scaling(free.lever);
  Matrix6d C = inverseOnObserved(H, free);
  const Vector6d up = s.cwiseInverse();
  const Matrix6d Q = projectorOntoSpace(free.space) - projectorOntoObserved(free);
  C += Q * (up.asDiagonal() * prior * up.asDiagonal()) * Q;
  C = s.asDiagonal() * C * s.asDiagonal();
  return 0.5 * (C + C.transpose());
}

}  // namespace laser_odometry
