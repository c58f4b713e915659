// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace urban_nav_core {

class Archive;

/// Estimate of a surface's slopes along the two axes of an image. The prior is a bivariate Cauchy distribution, which
/// corresponds to a uniform distribution of surface normals. Its heavy tails hardly bias the slope of a road or a wall
/// once observed; its peak keeps weak observations from producing slopes out of noise.
class Slope {
 public:
  struct Estimate {
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();
  };

  /// Adds an observation. `moment`: information times the most likely slope.
  void see(const Eigen::Vector2d& moment, const Eigen::Matrix2d& information);
  /// Returns the Gaussian nearest to the posterior, by variational Bayes over the scale of the prior (Bishop 2006,
  /// chapter 10). `usual`: slope of a surface at 45 deg to the line of sight.
  Estimate under(double usual) const;
  /// Returns the same estimate in other units: a slope of 1 here is `factor` there.
  Slope scaled(double factor) const;
  void archive(Archive& archive);

 private:
  Eigen::Vector2d moment_ = Eigen::Vector2d::Zero();
  Eigen::Matrix2d information_ = Eigen::Matrix2d::Zero();
};

}  // namespace urban_nav_core
