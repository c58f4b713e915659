// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "loop_metric/place/place_data.hpp"

namespace loop_metric {

/// Test of measured transforms against odometry between two poses.
class OdometryGate {
 public:
  /// `scale`: error common to all steps, as a share of the path length; added to the covariance, as it is not part of
  /// that of the chain.
  OdometryGate(const PlaceData::OdometryPath& path, double scale);

  /// Returns odometry with that error included.
  const urban_nav_core::PoseWithCovariance& T_a_b() const { return T_a_b_; }

  /// Returns the root mean square difference between `measured` and odometry, in standard deviations, over the
  /// directions with information in `measured`; the expected value is 1. 0 without information.
  double deviations(const urban_nav_core::Constraint& measured) const;
  /// Returns the minimum distance of the poses, m, for an error of odometry of at most this number of standard
  /// deviations.
  double leastDistance(double deviations) const;

 private:
  urban_nav_core::PoseWithCovariance T_a_b_;
};

/// Returns the root of the mean of d^T (covariance + information^-1)^-1 d over the directions with information.
/// `information` may be singular.
double rootMeanDeviation(const urban_nav_core::Vector6d& d, const urban_nav_core::Matrix6d& covariance,
                         const urban_nav_core::Matrix6d& information);

}  // namespace loop_metric
