// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "urban_nav_core/io/archive.hpp"
#include "window/image_region.hpp"
#include "window/landmark_score.hpp"

namespace swf_vo {

/// By how much the variance of the disparity offset is larger than its information says, learnt from residuals alone.
///
/// The sandwich of drift_sandwich.hpp for the one number that all frames share. A dead landmark's score of the offset,
/// with the drift of the camera eliminated,
///   s = g_o - A g_xi,   i = I_oo - 2 A I_xi,o + A I_xi,xi A^T,   A = (sum of I_o,xi) (sum of I_xi,xi)^-1,
/// has the variance i if measurements err independently. Scores of one region of the image are taken to be correlated
/// as there, and
///   ratio = sum(w s s) / sum(i).
/// All landmarks speak of the same number, so none of them has leverage on it worth mentioning.
///
/// Few clusters say little, and what all of them share is not seen: the logarithm of the ratio is the mean of the
/// measured one, weighted with the effective number of clusters, and of what is taken without any, weighted with 4.
class OffsetSandwich {
 public:
  /// The view has changed by as much (rad).
  void advance(double view_change);
  void add(const DriftScore& landmark);
  /// `without`: the ratio where no landmark has died.
  double ratio(double without) const;
  void archive(urban_nav_core::Archive& archive);

 private:
  struct Region {
    ImageRegion place = {0, 0};
    double score = 0.0, share = 0.0;  // sum w s; of all information
    void archive(urban_nav_core::Archive& archive);
  };
  Region& find(const Eigen::Vector2d& direction);

  urban_nav_core::Matrix6d drift_ = urban_nav_core::Matrix6d::Zero();  // sum I_xi,xi, faded
  urban_nav_core::Vector6d cross_ = urban_nav_core::Vector6d::Zero();  // sum I_xi,o, faded
  double information_ = 0.0;                                           // sum i
  double squares_ = 0.0;                                               // sum w s s
  double squared_shares_ = 1.0;
  std::vector<Region> regions_;
};

}  // namespace swf_vo
