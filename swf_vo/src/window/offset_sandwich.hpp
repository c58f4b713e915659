// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "urban_nav_core/io/archive.hpp"
#include "window/image_region.hpp"
#include "window/landmark_score.hpp"

namespace swf_vo {

/// Ratio of the actual variance of the disparity offset to that of its information, estimated from residuals.
///
/// The sandwich estimator of drift_sandwich.hpp for the one state common to all frames. The score of an ended landmark
/// for the offset, with the drift of the camera eliminated,
///   s = g_o - A g_xi, i = I_oo - 2 A I_xi,o + A I_xi,xi A^T, A = (sum of I_o,xi) (sum of I_xi,xi)^-1,
/// has the variance i if errors of measurements are independent. Scores of one region of the image are taken as
/// correlated as in drift_sandwich.hpp, and
///   ratio = sum(w s s) / sum(i).
/// All landmarks measure the same state, so the leverage of each is negligible.
///
/// A variance from few clusters is uncertain, and errors common to all clusters are not detected: the logarithm of the
/// ratio is the mean of the measured one, weighted by the effective number of clusters, and of the default without
/// data, with weight 4.
class OffsetSandwich {
 public:
  /// Decreases the weight of earlier scores after a view change (rad).
  void advance(double view_change);
  void add(const DriftScore& landmark);
  /// `without`: default ratio, used until landmarks have ended.
  double ratio(double without) const;
  void archive(urban_nav_core::Archive& archive);

 private:
  struct Region {
    ImageRegion place = {0, 0};
    double score = 0.0, share = 0.0;  // sum w s; of all information
    void archive(urban_nav_core::Archive& archive);
  };
  Region& find(const Eigen::Vector2d& direction);

  urban_nav_core::Matrix6d drift_ = urban_nav_core::Matrix6d::Zero();  // sum I_xi,xi, exponentially weighted
  urban_nav_core::Vector6d cross_ = urban_nav_core::Vector6d::Zero();  // sum I_xi,o, exponentially weighted
  double information_ = 0.0;                                           // sum i
  double squares_ = 0.0;                                               // sum w s s
  double squared_shares_ = 1.0;
  std::vector<Region> regions_;
};

}  // namespace swf_vo
