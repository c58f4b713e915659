// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/level.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "gravity/gravity_fit.hpp"
#include "gravity/level_axes.hpp"
#include "gravity/spans.hpp"

namespace pose_graph {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using urban_nav_core::Trajectory;

namespace {

constexpr std::size_t kLeastLevelSpans = 3;
// Lengths of spans for a session too short for three spans of 2 s: the longest that yields enough spans is used.
constexpr double kShortSpans[] = {1.0, 0.5, 0.25};  // s
constexpr std::size_t kLeastShortSpans = 5;
// Gravity is 9.78...9.83 m/s2 on the ground; the limits include a scale error of 2 % and the bias.
constexpr double kLeastGravity = 9.4, kMostGravity = 10.2;

struct LevelSpans {
  std::vector<Span> spans;  ///< empty: too few
  bool are_short = false;
};

LevelSpans chooseSpans(const Trajectory& trajectory, const std::vector<SpecificForce>& forces,
                       const urban_nav_core::Pose& T_world_first) {
  std::vector<Span> spans = makeSpans(trajectory, forces, T_world_first);
  if (spans.size() >= kLeastLevelSpans) return {std::move(spans), false};
  for (const double seconds : kShortSpans) {
    spans = makeSpans(trajectory, forces, T_world_first, seconds);
    if (spans.size() >= kLeastShortSpans) return {std::move(spans), true};
  }
  return {};
}

/// Returns the factor of the covariance for few spans: ratio of residuals to degrees of freedom after fitting three
/// parameters, times the variance of Student's t distribution with as many degrees of freedom.
double fewSpansFactor(std::size_t spans) {
  const double residuals = 3.0 * static_cast<double>(spans);
  return residuals / (residuals - 5.0);
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

Level estimateLevel(const Trajectory& trajectory, const std::vector<SpecificForce>& forces) {
  return estimateLevel(trajectory, forces, trajectory.empty() ? urban_nav_core::Pose() : trajectory.front().pose);
}

Level estimateLevel(const Trajectory& trajectory, const std::vector<SpecificForce>& forces,
                    const urban_nav_core::Pose& T_world_first) {
  if (forces.empty() || trajectory.empty())
    return unknownLevel(LevelTrouble::NoForces, "no accelerometer was recorded");
  const auto [spans, are_short] = chooseSpans(trajectory, forces, T_world_first);
  if (spans.empty()) return unknownLevel(LevelTrouble::TooShort, "the accelerometer was recorded for too short a time");
  const std::optional<GravityFit> fit = fitGravity(spans);
  const double gravity = fit ? fit->gravity().norm() : 0.0;
  if (!(gravity > kLeastGravity && gravity < kMostGravity))
    return unknownLevel(LevelTrouble::NotGravity, "the norm of the specific force is not that of gravity");
  Level level;
  level.trouble = LevelTrouble::None;
  level.gravity = gravity;
  level.up = fit->gravity() / gravity;
  const Matrix3d across = Matrix3d::Identity() - level.up * level.up.transpose();
  level.covariance = across * fit->covariance.topLeftCorner<3, 3>() * across / (gravity * gravity);
  if (are_short) level.covariance *= fewSpansFactor(spans.size());
  level.sigma = largestSigma(level.covariance);
  level.R_map_first = levelAxes(level.up);
  return level;
}

Level withRotations(Level level, const Matrix3d& covariance) {
  if (!level.known() || !covariance.allFinite()) return level;
  Matrix3d turned;
  // Derivative of `up` by a small rotation about axis i.
  for (int i = 0; i < 3; ++i) turned.col(i) = Vector3d::Unit(i).cross(level.up);
  level.covariance += turned * covariance * turned.transpose();
  level.sigma = largestSigma(level.covariance);
  return level;
}

}  // namespace pose_graph
