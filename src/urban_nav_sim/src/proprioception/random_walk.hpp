// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "noise/noise.hpp"

namespace urban_nav_sim {

/// Three independent drifting values: a normal initial value, then a walk whose variance grows by `walk`^2 per second,
/// or, with a time constant, a first-order Gauss-Markov process of constant variance. One node per second, linear
/// between nodes. Immutable, so thread-safe.
class RandomWalk {
 public:
  /// `duration`: s; later times give the last value.
  static RandomWalk free(double start_sigma, double walk, double duration, const Noise& noise);
  static RandomWalk drawnBack(double sigma, double time_constant, double duration, const Noise& noise);

  Eigen::Vector3d at(double t) const;

 private:
  explicit RandomWalk(std::vector<Eigen::Vector3d> nodes);

  std::vector<Eigen::Vector3d> nodes_;
};

}  // namespace urban_nav_sim
