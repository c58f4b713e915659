// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "urban_nav_core/io/archive.hpp"
#include "window/image_region.hpp"
#include "window/landmark_score.hpp"

namespace swf_vo {

/// Ratio of the actual variance of odometry's drift to that of the filter's model, estimated from residuals.
///
/// Each landmark whose life has ended has a score g, over its whole life, and the information I of the model. Scores of
/// one region of the image are taken as correlated, with weights w that decrease with the view change between the ends
/// of their lives. This accounts for errors that persist for a landmark's life, that are common to a surface, or that
/// belong to a position in the image. With the model's gain D = (sum of I)^-1 the measured variance is compared with
/// the expected one,
///   ratio = tr(D sum(w g g^T) D) / tr(D sum(w E[g g^T]) D), for translation and for rotation,
/// with E[g g^T] = I - I (X + I)^-1 I, X being the information of the other landmarks: the estimate follows each
/// landmark by its leverage. (Sandwich estimator: Huber 1967, White 1980; clusters: Liang and Zeger 1986; correlation
/// in space and time: Conley 1999, Driscoll and Kraay 1998; leverage: Bell and McCaffrey 2002.) Errors common to all
/// regions are not detected.
///
/// A variance from few clusters is uncertain: the ratio is the mean of the measured one, weighted by the effective
/// number of clusters (Kish 1965), and of 1, with weight 4. Derivation: docs/derivations/cluster_robust_drift.md.
class DriftSandwich {
 public:
  struct Ratio {
    double translation = 1.0, rotation = 1.0;  // ratios of variances
  };

  /// Decreases the weight of earlier scores after a view change (rad).
  void advance(double view_change);
  void add(const DriftScore& landmark);
  Ratio ratio() const;
  /// Returns the effective number of clusters, for translation (0) or rotation (1).
  double clusters(std::size_t part) const { return 1.0 / squared_shares_[part]; }
  void archive(urban_nav_core::Archive& archive);

 private:
  /// Landmarks that ended in one region of the image.
  struct Region {
    ImageRegion place = {0, 0};
    urban_nav_core::Vector6d score = urban_nav_core::Vector6d::Zero();        // sum w g
    urban_nav_core::Matrix6d information = urban_nav_core::Matrix6d::Zero();  // sum of I, of lives that overlap
    std::array<double, 2> share = {0.0, 0.0};                                 // share of all information
    void archive(urban_nav_core::Archive& archive);
  };
  Region& find(const Eigen::Vector2d& direction);

  double view_change_ = 0.0;                                                 // rad, covered by the sums
  double life_ = 0.0;                                                        // typical life, rad
  urban_nav_core::Matrix6d information_ = urban_nav_core::Matrix6d::Zero();  // sum I
  urban_nav_core::Matrix6d expected_ = urban_nav_core::Matrix6d::Zero();     // sum w E[g g^T]
  urban_nav_core::Matrix6d squares_ = urban_nav_core::Matrix6d::Zero();      // sum w g g^T
  std::array<double, 2> squared_shares_ = {1.0, 1.0};
  std::vector<Region> regions_;
};

}  // namespace swf_vo
