// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "loop_metric/place/place_data.hpp"

namespace loop_metric {

/// Odometry's word on how two moments lie to each other, to hold transforms against.
class OdometryGate {
 public:
  /// `scale`: what may be wrong with all steps in common, as a share of the way, is added to the covariance: the chain
  /// does not know it.
  OdometryGate(const PlaceData::Way& way, double scale);

  /// The same with that error in it.
  const urban_nav_core::PoseWithCovariance& T_a_b() const { return T_a_b_; }

  /// Root mean square of the difference between `measured` and odometry, in standard deviations, over the directions
  /// that `measured` knows anything of: 1 is usual. 0 where it knows nothing.
  double deviations(const urban_nav_core::Constraint& measured) const;
  /// m by which the moments are apart at least, if odometry is wrong by at most so many standard deviations.
  double leastDistance(double deviations) const;

 private:
  urban_nav_core::PoseWithCovariance T_a_b_;
};

/// Mean of d^T (covariance + information^-1)^-1 d over the directions with information, its root. `information` may be
/// singular.
double rootMeanDeviation(const urban_nav_core::Vector6d& d, const urban_nav_core::Matrix6d& covariance,
                         const urban_nav_core::Matrix6d& information);

}  // namespace loop_metric
