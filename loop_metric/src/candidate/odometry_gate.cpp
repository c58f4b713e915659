// SPDX-License-Identifier: BSD-3-Clause
#include "candidate/odometry_gate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "urban_nav_core/geometry/dense.hpp"

namespace loop_metric {

using urban_nav_core::Matrix6d;
using urban_nav_core::Vector6d;

namespace {

constexpr double kLeastSigma = 1e-4;           // m, rad: lower limit, as odometry between poses of one frame has no
                                               // covariance
constexpr double kGateMetresPerRadian = 10.0;  // makes the distinction of known and free directions independent of
                                               // units
constexpr double kKnown = 1e-9;                // relative to the best known direction

int directionsKnown(const Matrix6d& information) {
  Vector6d units;
  units << Eigen::Vector3d::Ones(), Eigen::Vector3d::Constant(1.0 / kGateMetresPerRadian);
  const auto values =
      urban_nav_core::symmetricEigenvalues(Eigen::MatrixXd(units.asDiagonal() * information * units.asDiagonal()));
  if (!values || !((*values)[5] > 0.0)) return 0;
  return static_cast<int>((values->array() > kKnown * (*values)[5]).count());
}

}  // namespace

double rootMeanDeviation(const Vector6d& d, const Matrix6d& covariance, const Matrix6d& information) {
  const int directions = directionsKnown(information);
  if (directions == 0) return 0.0;
  // (C + W^-1)^-1 = W - W (W + C^-1)^-1 W, also valid for singular W.
  const auto prior = urban_nav_core::invertPositiveDefinite(covariance);
  if (!prior) return 0.0;
  const auto both = urban_nav_core::invertPositiveDefinite(Matrix6d(information + *prior));
  if (!both) return 0.0;
  const Vector6d w = information * d;
  return std::sqrt(std::max(0.0, d.dot(w) - w.dot(*both * w)) / directions);
}

OdometryGate::OdometryGate(const PlaceData::OdometryPath& path, double scale) : T_a_b_(path.T_a_b) {
  const double common = scale * path.length;
  T_a_b_.covariance.diagonal().head<3>().array() += common * common + kLeastSigma * kLeastSigma;
  T_a_b_.covariance.diagonal().tail<3>().array() += kLeastSigma * kLeastSigma;
}

double OdometryGate::deviations(const urban_nav_core::Constraint& measured) const {
  return rootMeanDeviation(urban_nav_core::boxMinus(measured.T_a_b, T_a_b_.pose), T_a_b_.covariance,
                           measured.information);
}

double OdometryGate::leastDistance(double deviations) const {
  const double sigma = std::sqrt(T_a_b_.covariance.topLeftCorner<3, 3>().trace());
  return std::max(0.0, T_a_b_.pose.t().norm() - deviations * sigma);
}

}  // namespace loop_metric
