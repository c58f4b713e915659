// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "urban_nav_core/io/archive.hpp"
#include "window/image_region.hpp"
#include "window/landmark_score.hpp"

namespace swf_vo {

/// By how much the variance of odometry's drift is larger than the filter's model says, learnt from residuals alone.
///
/// Each landmark that has died has a score g, of its whole life, and the information I that the model gives it. Scores
/// of one region of the image are taken to be correlated, the less the more the view has changed between their deaths
/// (weights w): so errors count that last for a landmark's life, that a surface shares, or that belong to a place in
/// the image. Under the model's gain D = (sum of I)^-1 what there is stands beside what the model expects,
///   ratio = tr(D sum(w g g^T) D) / tr(D sum(w E[g g^T]) D), of translation and of rotation,
/// with E[g g^T] = I - I (X + I)^-1 I, X being the information of the others: the estimate follows each landmark by its
/// leverage. (Sandwich estimator: Huber 1967, White 1980; clusters: Liang and Zeger 1986; correlation in space and
/// time: Conley 1999, Driscoll and Kraay 1998; leverage: Bell and McCaffrey 2002.) Errors that all regions share are
/// not seen.
///
/// Few clusters say little of a variance: the ratio is the mean of the measured one, weighted with the effective number
/// of clusters (Kish 1965), and of 1, weighted with 4. Derivation: docs/derivations/cluster_robust_drift.md.
class DriftSandwich {
 public:
  struct Ratio {
    double translation = 1.0, rotation = 1.0;  // of variances
  };

  /// The view has changed by as much (rad): what was learnt before counts for less.
  void advance(double view_change);
  void add(const DriftScore& landmark);
  Ratio ratio() const;
  /// Returns the effective number of clusters, of translation (0) or of rotation (1).
  double clusters(std::size_t part) const { return 1.0 / squared_shares_[part]; }
  void archive(urban_nav_core::Archive& archive);

 private:
  /// What has died in one region of the image.
  struct Region {
    ImageRegion place = {0, 0};
    urban_nav_core::Vector6d score = urban_nav_core::Vector6d::Zero();        // sum w g
    urban_nav_core::Matrix6d information = urban_nav_core::Matrix6d::Zero();  // sum of I, of lives that overlap
    std::array<double, 2> share = {0.0, 0.0};                                 // of all information
    void archive(urban_nav_core::Archive& archive);
  };
  Region& find(const Eigen::Vector2d& direction);

  double view_change_ = 0.0;                                                 // rad, that the sums are of
  double life_ = 0.0;                                                        // usual one, rad
  urban_nav_core::Matrix6d information_ = urban_nav_core::Matrix6d::Zero();  // sum I
  urban_nav_core::Matrix6d expected_ = urban_nav_core::Matrix6d::Zero();     // sum w E[g g^T]
  urban_nav_core::Matrix6d squares_ = urban_nav_core::Matrix6d::Zero();      // sum w g g^T
  std::array<double, 2> squared_shares_ = {1.0, 1.0};
  std::vector<Region> regions_;
};

}  // namespace swf_vo
