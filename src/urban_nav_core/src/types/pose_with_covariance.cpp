// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/types/pose_with_covariance.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>

namespace urban_nav_core {
namespace {

// NaN compares as different.
bool closeTo(const Matrix6d& a, const Matrix6d& b, double tolerance) {
  return ((a - b).array().abs() <= tolerance).all();
}

void printSigmas(std::ostream& out, const Matrix6d& covariance) {
  const Vector6d sigma = covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  out << ", sigma = (" << sigma[0] << ", " << sigma[1] << ", " << sigma[2] << ") m, (" << sigma[3] << ", " << sigma[4]
      << ", " << sigma[5] << ") rad";
}

}  // namespace

bool isApprox(const PoseWithCovariance& a, const PoseWithCovariance& b, double tolerance) {
  return isApprox(a.pose, b.pose, tolerance) && closeTo(a.covariance, b.covariance, tolerance);
}

bool isFinite(const ConsideredConstant& constant) {
  return std::isfinite(constant.used) && std::isfinite(constant.mean) && std::isfinite(constant.sigma) &&
         constant.sensitivity.allFinite();
}

bool isApprox(const ConsideredConstant& a, const ConsideredConstant& b, double tolerance) {
  return a.name == b.name && std::abs(a.used - b.used) <= tolerance && std::abs(a.mean - b.mean) <= tolerance &&
         std::abs(a.sigma - b.sigma) <= tolerance &&
         ((a.sensitivity - b.sensitivity).array().abs() <= tolerance).all();
}

bool isApprox(const RelativePose& a, const RelativePose& b, double tolerance) {
  return a.from == b.from && a.to == b.to && a.status == b.status && a.source == b.source &&
         isApprox(a.T_from_to, b.T_from_to, tolerance) && closeTo(a.covariance, b.covariance, tolerance) &&
         closeTo(a.drift_covariance, b.drift_covariance, tolerance) &&
         std::equal(a.constants.begin(), a.constants.end(), b.constants.begin(), b.constants.end(),
                    [&](const auto& one, const auto& other) { return isApprox(one, other, tolerance); });
}

bool isApprox(const Constraint& a, const Constraint& b, double tolerance) {
  return isApprox(a.T_a_b, b.T_a_b, tolerance) && closeTo(a.information, b.information, tolerance);
}

std::ostream& operator<<(std::ostream& out, const PoseWithCovariance& value) {
  out << value.pose;
  printSigmas(out, value.covariance);
  return out;
}

std::ostream& operator<<(std::ostream& out, const RelativePose& value) {
  out << printStamp(value.from) << " -> " << printStamp(value.to) << " s: " << value.T_from_to;
  printSigmas(out, value.covariance);
  out << ", " << value.status;
  if (!value.source.empty()) out << ", from " << value.source;
  return out;
}

std::ostream& operator<<(std::ostream& out, const Constraint& value) {
  return out << value.T_a_b << ", information diagonal = (" << value.information.diagonal().transpose() << ")";
}

}  // namespace urban_nav_core
