// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace urban_nav_core {

class Archive;

/// How a piece of surface slopes along the two axes of an image: what pixels said so far, and what that means. Surfaces
/// may face any way: where all directions are as likely as each other, their slopes have a bivariate Cauchy
/// distribution, whose tails leave a road or a wall alongside its slope as soon as pixels speak of it, and whose middle
/// keeps what says little from making slopes of noise.
class Slope {
 public:
  struct Estimate {
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();
  };

  /// An observation: the slope at which it is most likely, times its information; and that information.
  void see(const Eigen::Vector2d& moment, const Eigen::Matrix2d& information);
  /// What is known of it, where a surface at 45 deg to the line of sight has a slope of `usual`: the Gaussian nearest
  /// to the posterior, by variational Bayes over the scale of the prior (Bishop 2006, chapter 10).
  Estimate under(double usual) const;
  /// The same, of slopes in other units: `factor` of them to one of these.
  Slope scaled(double factor) const;
  void archive(Archive& archive);

 private:
  Eigen::Vector2d moment_ = Eigen::Vector2d::Zero();
  Eigen::Matrix2d information_ = Eigen::Matrix2d::Zero();
};

}  // namespace urban_nav_core
