// SPDX-License-Identifier: BSD-3-Clause
#include "gap_error.hpp"

#include <algorithm>

#include "urban_nav_core/geometry/small_matrices.hpp"

namespace laser_odometry {
namespace {

constexpr double kOldShare = 0.5;  // majority of the information

/// Returns whether most of the information along a direction is that of surfaces first seen up to a sweep.
bool isMeasuredByOldMap(const std::vector<PatchMatch>& matches, const Vector6d& direction, std::int32_t sweep) {
  double old = 0.0, all = 0.0;
  for (const PatchMatch& match : matches) {
    const double along = match.row.jacobian().dot(direction);
    const double information = match.row.weight * match.robust * along * along;
    all += information;
    if (match.cell->first_sweep <= sweep) old += information;
  }
  return old > kOldShare * all;
}

}  // namespace

std::vector<Vector6d> freeTwists(const FreeSubspace& free, const Matrix3d& R_base_odom) {
  std::vector<Vector6d> twists;
  for (const Vector6d& direction : free.directions) {
    const Vector6d d = free.unscaled(direction);
    Vector6d turned;
    turned << R_base_odom * d.head<3>(), R_base_odom * d.tail<3>();
    twists.push_back(turned);
  }
  return twists;
}

void GapError::extend(const Matrix6d& along_free, std::int32_t directions, std::int32_t sweep) {
  if (directions == 0) return;
  if (directions_ == 0) begin_ = sweep - 1;
  directions_ = directions;
  covariance_ += along_free;
}

FreeSubspace GapError::average(const FreeSubspace& free) {
  if (static_cast<std::int32_t>(free.directions.size()) != directions_) projectors_.setZero();
  FreeSubspace mean = free;
  if (!free.isFree()) return mean;
  for (const Vector6d& v : free.directions) projectors_ += v * v.transpose();
  const urban_nav_core::SmallEigen<6> eigen = urban_nav_core::smallEigen<6>(projectors_);  // values ascend
  for (std::size_t i = 0; i < mean.directions.size(); ++i)
    mean.directions[i] = eigen.vectors.col(5 - static_cast<int>(i));
  return mean;
}

Matrix6d GapError::close(const Registration& registration) {
  if (directions_ == 0) return Matrix6d::Zero();
  const FreeSubspace& free = registration.free;
  Matrix6d F = Matrix6d::Zero();
  for (const Vector6d& v : free.directions) F += free.unscaled(v) * free.scaled(v).transpose();
  const Matrix6d rest = Matrix6d::Identity() - F, measured = rest * covariance_ * rest.transpose();
  covariance_ = (F * covariance_ * F.transpose()).eval();
  const auto still_free = static_cast<std::int32_t>(free.directions.size());
  const std::int32_t closed = std::max(0, directions_ - still_free);
  directions_ = still_free;
  // Free directions vary by noise, so that `measured` has small parts along others: those that closed are its
  // strongest.
  const urban_nav_core::SmallEigen<6> eigen = urban_nav_core::smallEigen<6>(measured);  // values ascend
  Matrix6d returned = Matrix6d::Zero();
  for (int i = 6 - closed; i < 6; ++i) {
    const Vector6d direction = eigen.vectors.col(i);
    if (eigen.values[i] > 0.0 && isMeasuredByOldMap(registration.matches, direction, begin_))
      returned += eigen.values[i] * direction * direction.transpose();
  }
  return returned;
}

}  // namespace laser_odometry
