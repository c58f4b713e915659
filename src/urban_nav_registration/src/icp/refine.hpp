// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "icp/normal_equations.hpp"

namespace urban_nav_registration {

/// A target with its index for each level from coarse to fine, created once for any number of starts.
class Target {
 public:
  /// `coarsest`: maximum correspondence distance at the first level, m; halved per level down to twice the voxel.
  Target(const Surfels& surfels, double coarsest);
  const std::vector<std::shared_ptr<const SurfelIndex>>& steps() const { return steps_; }

 private:
  std::vector<std::shared_ptr<const SurfelIndex>> steps_;  // each searches the next finer one first
};

/// A source thinned for each level of a Target to one surfel (the most planar one) per cube of half the reach or more,
/// and a last level with all surfels against the finest index.
class Source {
 public:
  Source(const Surfels& surfels, const Target& target);
  const std::vector<std::vector<Surfel>>& steps() const { return steps_; }

 private:
  std::vector<std::vector<Surfel>> steps_;
};

struct Refined {
  Pose T_target_source;
  std::vector<Match> matches;  ///< at that pose
  double sigma = 0.0;          ///< robust standard deviation of the residuals, m
  double last_step = 0.0;      ///< change of the planes' distances in the last Gauss-Newton step, root mean square, m
  int iterations = 0;
  bool usable = false;  ///< false: too few matches to solve for a pose
};

/// Gauss-Newton on point-to-plane distances (Chen and Medioni 1992) on SE(3), from coarse to fine, with Cauchy weights
/// at the scale of the residuals. Over-relaxed, since iteratively reweighted steps converge at half speed. Uses the
/// levels of the source from `first` (0: the coarsest) to before `end`, at least one.
Refined refine(const Source& source, const Target& target, const Pose& start, std::size_t first, std::size_t end,
               int iterations);

}  // namespace urban_nav_registration
