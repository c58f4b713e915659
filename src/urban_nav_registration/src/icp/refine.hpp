// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "icp/normal_equations.hpp"

namespace urban_nav_registration {

/// A target with its index for each step from coarse to fine, made once for any number of starts.
class Target {
 public:
  /// `coarsest`: how far a counterpart may be away in the first step, m; halved down to twice the voxel.
  Target(const Surfels& surfels, double coarsest);
  const std::vector<std::shared_ptr<const SurfelIndex>>& steps() const { return steps_; }

 private:
  std::vector<std::shared_ptr<const SurfelIndex>> steps_;  // each asks the next one first
};

/// A source thinned for each step of a Target, to one surfel (the most planar) per cube of half the reach or more, and
/// a last step with all of them against the finest.
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
  double sigma = 0.0;          ///< robust deviation of the residuals, m
  double last_step =
      0.0;  ///< by how much the last Gauss-Newton step would move the planes' distances, root mean square, m
  int iterations = 0;
  bool usable = false;  ///< false: too few matches to solve for a pose
};

/// Gauss-Newton of point-to-plane distances (Chen and Medioni 1992) on SE(3), from coarse to fine, with Cauchy's weight
/// at the spread that the residuals show, over-relaxed: those weights alone come near at half speed. The steps of the
/// source from `first` (0: the coarsest) to before `end`, at least one.
Refined refine(const Source& source, const Target& target, const Pose& start, std::size_t first, std::size_t end,
               int iterations);

}  // namespace urban_nav_registration
