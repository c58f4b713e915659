// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/view_motion.hpp"

#include <cmath>

namespace laser_mapper {

using Eigen::Vector3d;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::Trajectory;

namespace {

constexpr StampNs kLongestPoseGap = 500'000'000;
constexpr double kDelayStep = 0.01, kPoseStep = 1e-4;  // s; m and rad: steps of numeric derivatives

std::optional<Pose> cameraFromMap(const MountedView& view, const Trajectory& T_map_base, const Vector3d& centre,
                                  const TermVector& terms) {
  const auto pose = T_map_base.at(view.stamp - std::llround(1e9 * delaySeconds(terms)), kLongestPoseGap);
  if (!pose) return std::nullopt;
  return (*pose * headCorrection(terms, centre) * view.T_base_camera).inverse();
}

}  // namespace

Pose headCorrection(const TermVector& terms, const Vector3d& centre) {
  const Pose T_head(Eigen::Quaterniond::Identity(), centre);
  return T_head * statedToTrue(terms) * T_head.inverse();
}

Eigen::Matrix<double, 3, kCalibrationTerms> ViewMotion::derivatives(const Vector3d& p) const {
  Eigen::Matrix<double, 3, kCalibrationTerms> all;
  for (int i = 0; i < kCalibrationTerms; ++i)
    all.col(i) = dR[static_cast<std::size_t>(i)] * p + dt[static_cast<std::size_t>(i)];
  return all;
}

std::optional<ViewMotion> viewMotionAt(const MountedView& view, const Trajectory& T_map_base, const Vector3d& centre,
                                       const TermVector& terms) {
  const auto T_camera_map = cameraFromMap(view, T_map_base, centre, terms);
  if (!T_camera_map) return std::nullopt;
  ViewMotion motion;
  motion.R = T_camera_map->R();
  motion.t = T_camera_map->t();
  for (int i = 0; i < kCalibrationTerms; ++i) {
    const double step = i == 0 ? kDelayStep : kPoseStep;
    TermVector change = TermVector::Zero();
    change(i) = step;
    const auto after = cameraFromMap(view, T_map_base, centre, changedTerms(terms, change)),
               before = cameraFromMap(view, T_map_base, centre, changedTerms(terms, -change));
    if (!after || !before) return std::nullopt;
    motion.dR[static_cast<std::size_t>(i)] = (after->R() - before->R()) / (2.0 * step);
    motion.dt[static_cast<std::size_t>(i)] = (after->t() - before->t()) / (2.0 * step);
  }
  return motion;
}

}  // namespace laser_mapper
