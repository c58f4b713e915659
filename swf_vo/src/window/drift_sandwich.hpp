// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "urban_nav_core/io/archive.hpp"
#include "window/landmark_score.hpp"

namespace swf_vo {

/// By how much the variance of odometry's drift is larger than the filter's model says, learnt from residuals alone.
///
/// Each landmark that has died is a cluster, with the score g of its whole life and the information I that the model
/// gives it. The model expects g g^T = I - I (X + I)^-1 I, X being the information of the others, for the estimate
/// follows each landmark by its leverage. What there is beside what is expected, under the model's gain
/// D = (sum of I)^-1:
///   ratio = tr(D sum(g g^T) D) / tr(D sum(I - I (X + I)^-1 I) D), of translation and of rotation.
/// (Sandwich estimator: Huber 1967, White 1980; clusters: Liang and Zeger 1986; leverage: Bell and McCaffrey 2002.)
/// It sees whatever errors are individual to landmarks, however long they last, and none that all landmarks share.
///
/// Few clusters say little of a variance: the ratio is a mean of what was measured, weighted with the effective number
/// of clusters (Kish 1965), and of 1, weighted with 20, the number below which such estimates are taken to be poor
/// (Cameron and Miller 2015, section VI). Derivation: docs/derivations/cluster_robust_drift.md.
class DriftSandwich {
 public:
  struct Ratio {
    double translation = 1.0, rotation = 1.0;  // of variances
  };

  /// The view has changed by as much (rad): what was learnt before counts for less.
  void advance(double view_change);
  void add(const DriftScore& landmark);
  Ratio ratio() const;
  /// Effective number of clusters, of translation and of rotation.
  double clusters(std::size_t part) const;
  void archive(urban_nav_core::Archive& archive);

 private:
  double view_change_ = 0.0;                                                 // rad, that the sums are of
  urban_nav_core::Matrix6d information_ = urban_nav_core::Matrix6d::Zero();  // sum I
  urban_nav_core::Matrix6d expected_ = urban_nav_core::Matrix6d::Zero();     // sum I - I (X + I)^-1 I
  urban_nav_core::Matrix6d squares_ = urban_nav_core::Matrix6d::Zero();      // sum g g^T
  std::array<double, 2> squared_shares_ = {1.0, 1.0};                        // of each landmark in the sum, in all
};

}  // namespace swf_vo
