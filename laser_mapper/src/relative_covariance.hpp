// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "urban_nav_core/trajectory/trajectory.hpp"

namespace laser_mapper {

/// Covariances of the poses of a session after the best alignment of all of them, in the axes of the map: the
/// uncertainty that remains when the whole map is aligned with the truth. Derived from those relative to the first
/// pose, assuming independent steps of the trajectory; where closures make a difference indefinite, the absolute values
/// of its eigenvalues are used. Immutable, hence thread-safe.
class RelativeCovariances {
 public:
  /// `T_first_base`: covariances, one per pose; poses after the last one count as exact.
  RelativeCovariances(const urban_nav_core::Trajectory& T_map_base,
                      const std::vector<urban_nav_core::Matrix6d>& T_first_base);
  /// Takes values() of another object. Requires at least one.
  explicit RelativeCovariances(std::vector<urban_nav_core::Matrix6d> values) : covariances_(std::move(values)) {}
  /// Returns the covariances of every kSpacing-th pose.
  const std::vector<urban_nav_core::Matrix6d>& values() const { return covariances_; }
  /// Returns the covariance of a pose, by its index in the trajectory: that of a pose at most kSpacing away.
  const urban_nav_core::Matrix6d& at(std::size_t pose) const;

 private:
  static constexpr std::size_t kSpacing = 8;
  std::vector<urban_nav_core::Matrix6d> covariances_;  // of every kSpacing-th pose
};

}  // namespace laser_mapper
