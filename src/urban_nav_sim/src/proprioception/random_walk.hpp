// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "noise/noise.hpp"

namespace urban_nav_sim {

/// Three values that drift independently: a normal start, then a walk whose variance grows by `walk`^2 a second, or,
/// with a time constant, one that is drawn back and keeps the variance of its start (first-order Gauss-Markov). A node
/// a second, straight between them. Immutable, so thread-safe.
class RandomWalk {
 public:
  /// `duration`: up to which time (s) it is asked; later ones give the last value.
  static RandomWalk free(double start_sigma, double walk, double duration, const Noise& noise);
  static RandomWalk drawnBack(double sigma, double time_constant, double duration, const Noise& noise);

  Eigen::Vector3d at(double t) const;

 private:
  explicit RandomWalk(std::vector<Eigen::Vector3d> nodes);

  std::vector<Eigen::Vector3d> nodes_;
};

}  // namespace urban_nav_sim
