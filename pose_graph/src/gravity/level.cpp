// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/level.hpp"

#include <algorithm>
#include <cmath>

#include "gravity/spans.hpp"
#include "urban_nav_core/geometry/dense.hpp"

namespace pose_graph {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using urban_nav_core::Matrix6d;
using urban_nav_core::Trajectory;
using urban_nav_core::Vector6d;

namespace {

constexpr std::size_t kLeastSpans = 3;
// What is wrong with an accelerometer, m/s2: across gravity 1 deg of its place on the robot, along it the bias of a calibrated one (XSens MTi).
constexpr double kFaultAcross = 9.81 * 0.01745, kFaultAlong = 0.02;
// Gravity is 9.78...9.83 on the ground; a scale of 2 % and that fault are allowed for.
constexpr double kLeastGravity = 9.4, kMostGravity = 10.2;
constexpr double kHuber = 1.345;         // Huber 1964: 95 % as good as least squares where nothing is wrong
constexpr double kMadToSigma = 1.4826;   // of a Gaussian
constexpr double kLeastScatter = 0.002;  // m/s2: a span's mean is not better than its velocities
constexpr int kRounds = 20;

/// Gravity in the first pose's axes, and the accelerometer's fault in base_link's.
struct Fit {
  Vector6d x = Vector6d::Zero();
  Matrix6d covariance = Matrix6d::Identity();
};

Vector3d residual(const Span& span, const Vector6d& x) {
  return span.force - x.head<3>() - span.rotation * x.tail<3>();
}

/// What is known of the fault beforehand.
Matrix3d faultInformation(const std::vector<Span>& spans) {
  Vector3d along = Vector3d::Zero();
  for (const Span& span : spans) along += span.rotation.transpose() * span.force;
  if (along.norm() > 0.0) along.normalize();
  const Matrix3d outer = along * along.transpose();
  return (Matrix3d::Identity() - outer) / (kFaultAcross * kFaultAcross) + outer / (kFaultAlong * kFaultAlong);
}

std::optional<Fit> solve(const std::vector<Span>& spans, const std::vector<double>& weights, double scatter) {
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
  return Fit{*covariance * rhs, *covariance};
}

double scatterOf(const std::vector<Span>& spans, const Vector6d& x) {
  std::vector<double> sizes;
  for (const Span& span : spans)
    for (int axis = 0; axis < 3; ++axis) sizes.push_back(std::abs(residual(span, x)(axis)));
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return std::max(kLeastScatter, kMadToSigma * *middle);
}

/// Reweighted least squares from the medians of the forces.
std::optional<Fit> robustFit(const std::vector<Span>& spans) {
  Fit fit;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const Span& span : spans) values.push_back(span.force(axis));
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    fit.x(axis) = *middle;
  }
  for (int round = 0; round < kRounds; ++round) {
    const double scatter = scatterOf(spans, fit.x);
    std::vector<double> weights;
    for (const Span& span : spans) {
      const double size = residual(span, fit.x).norm() / (scatter * std::sqrt(3.0));
      weights.push_back(size <= kHuber ? 1.0 : kHuber / size);
    }
    const std::optional<Fit> next = solve(spans, weights, scatter);
    if (!next) return std::nullopt;
    fit = *next;
  }
  return fit;
}

Matrix3d levelAxes(const Vector3d& up) {
  Matrix3d rows;
  Vector3d ahead = Vector3d::UnitX() - up.x() * up;
  if (ahead.norm() < 1e-3) ahead = up.unitOrthogonal();  // it points up or down: no heading to keep
  ahead.normalize();
  rows << ahead.transpose(), up.cross(ahead).transpose(), up.transpose();
  return rows;
}

double largestSigma(const Matrix3d& covariance) {
  const auto values = urban_nav_core::symmetricEigenvalues(covariance);
  return values ? std::sqrt(std::max(0.0, values->maxCoeff())) : 0.0;
}

Level unknown(LevelTrouble trouble, const std::string& sentence) {
  Level level;
  level.trouble = trouble;
  level.sentence = sentence;
  return level;
}

}  // namespace

const char* toString(LevelTrouble trouble) {
  switch (trouble) {
    case LevelTrouble::None: return "None";
    case LevelTrouble::NoForces: return "NoForces";
    case LevelTrouble::TooShort: return "TooShort";
    case LevelTrouble::NotGravity: return "NotGravity";
  }
  return "";
}

Level levelOf(const Trajectory& trajectory, const std::vector<FeltForce>& forces) {
  return levelOf(trajectory, forces, trajectory.empty() ? urban_nav_core::Pose() : trajectory.front().pose);
}

Level levelOf(const Trajectory& trajectory, const std::vector<FeltForce>& forces,
              const urban_nav_core::Pose& T_world_first) {
  if (forces.empty() || trajectory.empty()) return unknown(LevelTrouble::NoForces, "no accelerometer was recorded");
  const std::vector<Span> spans = spansOf(trajectory, forces, T_world_first);
  if (spans.size() < kLeastSpans)
    return unknown(LevelTrouble::TooShort, "the accelerometer was recorded for too short a time");
  const std::optional<Fit> fit = robustFit(spans);
  const double gravity = fit ? fit->x.head<3>().norm() : 0.0;
  if (!(gravity > kLeastGravity && gravity < kMostGravity))
    return unknown(LevelTrouble::NotGravity, "what the accelerometer felt has not the size of gravity");
  Level level;
  level.trouble = LevelTrouble::None;
  level.gravity = gravity;
  level.up = fit->x.head<3>() / gravity;
  const Matrix3d across = Matrix3d::Identity() - level.up * level.up.transpose();
  level.covariance = across * fit->covariance.topLeftCorner<3, 3>() * across / (gravity * gravity);
  level.sigma = largestSigma(level.covariance);
  level.R_map_first = levelAxes(level.up);
  return level;
}

Level withRotations(Level level, const Matrix3d& covariance) {
  if (!level.known() || !covariance.allFinite()) return level;
  Matrix3d turned;
  for (int i = 0; i < 3; ++i) turned.col(i) = Vector3d::Unit(i).cross(level.up);  // of a small turn about axis i
  level.covariance += turned * covariance * turned.transpose();
  level.sigma = largestSigma(level.covariance);
  return level;
}

}  // namespace pose_graph
