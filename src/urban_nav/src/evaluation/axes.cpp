// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/axes.hpp"

#include <algorithm>

#include "urban_nav_core/trajectory/errors.hpp"
#include "urban_nav_input/truth/trajectory_file.hpp"
#include "urban_nav_ros/extrinsics.hpp"

namespace urban_nav {

using urban_nav_core::Matched;
using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;

namespace {

double errorWith(Axes axes, Matched matched) {
  applyAxes(axes, matched);
  return urban_nav_core::absoluteError(matched.truth, matched.estimate, urban_nav_core::TrajectoryAlignment::First)
      .rmse;
}

}  // namespace

Axes detectAxes(const Matched& matched) {
  constexpr double kBetter = 0.1, kOfPath = 0.2;
  if (matched.truth.size() < 2) return Axes::Same;
  const double length = urban_nav_core::pathLength(matched.truth), same = errorWith(Axes::Same, matched);
  if (same <= kOfPath * kBetter * length) return Axes::Same;
  const double estimate = errorWith(Axes::EstimateOptical, matched), truth = errorWith(Axes::TruthOptical, matched);
  const double best = std::min(estimate, truth);
  if (!(best < kBetter * same && best < kOfPath * length)) return Axes::Same;
  return estimate <= truth ? Axes::EstimateOptical : Axes::TruthOptical;
}

void applyAxes(Axes axes, Matched& matched) {
  if (axes == Axes::Same) return;
  for (Pose& pose : axes == Axes::EstimateOptical ? matched.estimate : matched.truth)
    pose = urban_nav_input::opticalToBody(pose);
}

Matrix6d applyAxes(Axes axes, const Matrix6d& covariance) {
  if (axes != Axes::EstimateOptical) return covariance;
  Matrix6d turn = Matrix6d::Zero();
  turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = urban_nav_ros::opticalInBody().q().toRotationMatrix();
  return turn * covariance * turn.transpose();
}

const char* describe(Axes axes) {
  switch (axes) {
    case Axes::EstimateOptical:
      return "the estimate has the axes of a camera (z forward), the truth those of a body (x forward): the estimate "
             "is turned";
    case Axes::TruthOptical:
      return "the truth has the axes of a camera (z forward), the estimate those of a body (x forward): the truth is "
             "turned";
    case Axes::Same: break;
  }
  return "";
}

}  // namespace urban_nav
