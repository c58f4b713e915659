// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "urban_nav_core/types/specific_force.hpp"

namespace dense_stereo {

/// Low-pass filter of specific forces, whose mean over a second is opposite to gravity: accelerations of a ground robot
/// tilt it by a few degrees at most. Not thread-safe.
class GravityFilter {
 public:
  /// Adds a sample. Samples that are not finite are ignored; a gap of more than 1 s, or a backward stamp, resets the
  /// filter.
  void add(const urban_nav_core::SpecificForce& sample);
  /// Returns the upward unit vector in base_link. nullopt: no sample within 1 s of `stamp`, less than 1 s of samples,
  /// or a mean whose length is not that of gravity.
  std::optional<Eigen::Vector3d> up(urban_nav_core::StampNs stamp) const;

 private:
  std::optional<urban_nav_core::StampNs> first_, last_;
  Eigen::Vector3d force_ = Eigen::Vector3d::Zero();
};

}  // namespace dense_stereo
