// SPDX-License-Identifier: BSD-3-Clause
#include "gravity/gravity_fit.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/geometry/dense.hpp"

namespace pose_graph {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using urban_nav_core::Matrix6d;
using urban_nav_core::Vector6d;

namespace {

// Standard deviation of accelerometer bias, m/s2: across gravity 1 deg of mounting error, along gravity the bias of a
// calibrated sensor (XSens MTi).
constexpr double kFaultAcross = 9.81 * 0.01745, kFaultAlong = 0.02;
constexpr double kGravityHuber = 1.345;  // Huber 1964: 95 % efficiency for normal errors
constexpr double kMadToSigma = 1.4826;   // for a normal distribution
constexpr double kLeastScatter = 0.002;  // m/s2: limited by the velocities of the trajectory
constexpr int kGravityRounds = 20;

/// Returns the prior information of the bias.
Matrix3d faultInformation(const std::vector<Span>& spans) {
  Vector3d along = Vector3d::Zero();
  for (const Span& span : spans) along += span.rotation.transpose() * span.force;
  if (along.norm() > 0.0) along.normalize();
  const Matrix3d outer = along * along.transpose();
  return (Matrix3d::Identity() - outer) / (kFaultAcross * kFaultAcross) + outer / (kFaultAlong * kFaultAlong);
}

std::optional<GravityFit> solve(const std::vector<Span>& spans, const std::vector<double>& weights, double scatter) {
  const double information = 1.0 / (scatter * scatter);
  Matrix6d H = Matrix6d::Zero();
  Vector6d rhs = Vector6d::Zero();
  H.bottomRightCorner<3, 3>() = faultInformation(spans);
  for (std::size_t i = 0; i < spans.size(); ++i) {
    Eigen::Matrix<double, 3, 6> A;
    A << Matrix3d::Identity(), spans[i].rotation;
    H += weights[i] * information * A.transpose() * A;
    rhs += weights[i] * information * A.transpose() * spans[i].force;
  }
  const auto covariance = urban_nav_core::invertPositiveDefinite(H);
  if (!covariance) return std::nullopt;
  return GravityFit{*covariance * rhs, *covariance};
}

double computeScatter(const std::vector<Span>& spans, const GravityFit& fit) {
  std::vector<double> sizes;
  for (const Span& span : spans)
    for (int axis = 0; axis < 3; ++axis) sizes.push_back(std::abs(fit.residual(span)(axis)));
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return std::max(kLeastScatter, kMadToSigma * *middle);
}

}  // namespace

std::optional<GravityFit> fitGravity(const std::vector<Span>& spans) {
  GravityFit fit;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const Span& span : spans) values.push_back(span.force(axis));
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    fit.x(axis) = *middle;
  }
  for (int round = 0; round < kGravityRounds; ++round) {
    const double scatter = computeScatter(spans, fit);
    std::vector<double> weights;
    for (const Span& span : spans) {
      const double size = fit.residual(span).norm() / (scatter * std::sqrt(3.0));
      weights.push_back(size <= kGravityHuber ? 1.0 : kGravityHuber / size);
    }
    const std::optional<GravityFit> next = solve(spans, weights, scatter);
    if (!next) return std::nullopt;
    fit = *next;
  }
  fit.scatter = computeScatter(spans, fit);
  return fit;
}

}  // namespace pose_graph
