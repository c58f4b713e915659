// SPDX-License-Identifier: BSD-3-Clause
#include "topics/fusion/fused_session.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/geometry/covariance_frames.hpp"
#include "urban_nav_core/io/format_number.hpp"

namespace urban_nav {

using urban_nav_core::formatNumber;
using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;
using urban_nav_core::RelativePose;
using urban_nav_core::transformCovariance;
using urban_nav_core::Vector6d;

namespace {

constexpr double kNotableScale = 0.003;   // relative; a calibration target measures a baseline more accurately
constexpr double kNotableMounting = 0.5;  // deg
constexpr double kDeviations = 3.0;       // sigmas from the prior above which a constant is reported

std::vector<RelativePose> listSteps(const SessionOdometry& run) {
  std::vector<RelativePose> steps;
  for (std::size_t i = 1; i < run.settled.size(); ++i) steps.push_back(run.settled[i].from_previous);
  return steps;
}

/// Covariance of the pose relative to the first one along a chain of steps: drifts, errors of both ends, and constants
/// common to all steps.
class PathCovariance {
 public:
  /// Appends a step. Returns the covariance in the frame of the first pose.
  Matrix6d append(const RelativePose& step) {
    const Matrix6d to_first = urban_nav_core::adjoint(T_first_) * urban_nav_core::leftFromBox(step.T_from_to);
    const Matrix6d half = transformCovariance(to_first, 0.5 * step.covariance);
    if (is_first_) sum_ = half;
    is_first_ = false;
    sum_ += transformCovariance(to_first, step.drift_covariance);
    constants_.resize(std::max(constants_.size(), step.constants.size()), Vector6d::Zero());
    for (std::size_t k = 0; k < step.constants.size(); ++k)
      constants_[k] += step.constants[k].sigma * to_first * step.constants[k].sensitivity;
    T_first_ = T_first_ * step.T_from_to;
    Matrix6d all = sum_ + half;
    for (const Vector6d& constant : constants_) all += constant * constant.transpose();
    return transformCovariance(urban_nav_core::boxFromLeft(T_first_), all);
  }

 private:
  Pose T_first_;
  Matrix6d sum_ = Matrix6d::Zero();
  std::vector<Vector6d> constants_;
  bool is_first_ = true;
};

}  // namespace

SessionOdometry fuseSession(const SessionOdometry& stereo, const SessionOdometry& laser) {
  urban_nav_core::FusedOdometry fused =
      urban_nav_core::fuseOdometry(listSteps(stereo), listSteps(laser), laser.T_base_lidar.value_or(Pose()).t());
  SessionOdometry run = stereo;
  run.source = OdometrySource::Both;
  PathCovariance path;
  for (std::size_t i = 1; i < run.settled.size(); ++i) {
    SmoothedFrame& frame = run.settled[i];
    frame.from_previous = fused.steps[i - 1];
    frame.status = frame.from_previous.status;
    frame.T_odom_base.pose = run.settled[i - 1].T_odom_base.pose * frame.from_previous.T_from_to;
    frame.T_odom_base.covariance = path.append(frame.from_previous);
  }
  for (std::size_t i = 0, k = 0; i < run.settled.size(); ++i) {
    while (k < run.frames.size() && run.frames[k].frame != run.settled[i].frame) ++k;
    if (k == run.frames.size()) break;
    run.frames[k].T_odom_base = run.settled[i].T_odom_base.pose;
    run.frames[k].status = run.settled[i].status;
  }
  run.fusion =
      OdometryFusion{std::move(fused.sources), std::move(fused.shared), std::move(fused.conflicts), fused.spread};
  return run;
}

std::vector<std::string> conflictSentences(const SessionOdometry& fused) {
  if (!fused.fusion || fused.fusion->conflicts.empty()) return {};
  const auto& conflicts = fused.fusion->conflicts;
  const auto worst = std::max_element(conflicts.begin(), conflicts.end(),
                                      [](const auto& a, const auto& b) { return a.statistic < b.statistic; });
  const auto since = [&](urban_nav_core::StampNs stamp) {
    return formatNumber(urban_nav_core::secondsBetween(fused.settled.front().stamp, stamp), 4);
  };
  return {fused.input + ": stereo and LiDAR odometry contradict each other in " + std::to_string(conflicts.size()) +
          " stretches of 1 s, most between " + since(worst->from) + " and " + since(worst->to) + " s: by " +
          formatNumber(worst->distance_m, 3) + " m and " + formatNumber(worst->angle_rad * 180.0 / M_PI, 3) + " deg, " +
          formatNumber(std::sqrt(worst->statistic / 6.0), 3) +
          " times their combined standard deviation. One of them is wrong there, and the covariance is enlarged. "
          "Compare --odometry stereo and --odometry laser, and check clocks and mounting"};
}

std::vector<std::string> constantSentences(const SessionOdometry& fused) {
  std::vector<std::string> sentences;
  if (!fused.fusion) return sentences;
  for (const urban_nav_core::SharedConstant& constant : fused.fusion->shared) {
    if (std::abs(constant.value) < kDeviations * constant.sigma) continue;
    const double degrees = constant.value * 180.0 / M_PI;
    if (constant.name == "scale" && std::abs(constant.value) > kNotableScale)
      sentences.push_back(fused.input + ": stereo lengths are " + formatNumber(-100.0 * constant.value, 3) +
                          " % too large (+-" + formatNumber(100.0 * constant.sigma, 2) +
                          " %) compared with the LiDAR and are corrected; check baseline and focal length");
    if (constant.is_applied && constant.name.rfind("mounting_", 0) == 0 && std::abs(degrees) > kNotableMounting)
      sentences.push_back(fused.input + ": the LiDAR is rotated by " + formatNumber(degrees, 3) + " deg (+-" +
                          formatNumber(constant.sigma * 180.0 / M_PI, 2) + ") about " + constant.name.back() +
                          " of base_link relative to its mounting in tf, which is corrected in the odometry");
  }
  return sentences;
}

}  // namespace urban_nav
