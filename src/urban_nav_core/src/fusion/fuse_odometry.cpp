// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/fusion/fuse_odometry.hpp"

#include <algorithm>

#include "fusion/interval_motion.hpp"
#include "fusion/shared_constants.hpp"
#include "urban_nav_core/geometry/covariance_frames.hpp"
#include "urban_nav_core/geometry/small_matrices.hpp"

namespace urban_nav_core {

namespace {

constexpr StampNs kStretch = 1'000'000'000;  // ns: long enough that the errors of the end poses are small
constexpr double kConflict = 53.0;           // squared Mahalanobis distance; 1e-9 of chi-square with 6 degrees of
                                             // freedom

/// Returns the laser's motion over each stereo step; nullopt where it is unavailable.
std::vector<std::optional<IntervalMotion>> motionsByLaser(const std::vector<RelativePose>& stereo,
                                                          const InterpolatedOdometry& laser) {
  std::vector<std::optional<IntervalMotion>> motions;
  for (const RelativePose& step : stereo) {
    motions.push_back(laser.over(step.from, step.to));
    if (motions.back() && motions.back()->is_lost) motions.back().reset();
  }
  return motions;
}

StepSource findSource(const RelativePose& stereo, bool has_laser) {
  const bool has_stereo = stereo.status.health != Health::Lost;
  if (has_stereo) return has_laser ? StepSource::Both : StepSource::Stereo;
  return has_laser ? StepSource::Laser : StepSource::None;
}

std::vector<Stretch> findStretches(const std::vector<RelativePose>& steps, const std::vector<StepSource>& sources,
                                   const InterpolatedOdometry& stereo, const InterpolatedOdometry& laser) {
  std::vector<Stretch> stretches;
  for (std::size_t first = 0; first < steps.size();) {
    std::size_t end = first;
    while (end < steps.size() && sources[end] == StepSource::Both &&
           (end == first || steps[end - 1].to - steps[first].from < kStretch))
      ++end;
    if (end > first) {
      Stretch stretch{first, end, steps[first].from, steps[end - 1].to, {}, {}, 0.0};
      const std::optional<IntervalMotion> a = stereo.over(stretch.from, stretch.to),
                                          b = laser.over(stretch.from, stretch.to);
      if (a && b) {
        stretch.stereo = *a;
        stretch.laser = *b;
        stretches.push_back(std::move(stretch));
      }
    }
    first = std::max(end, first + 1);
  }
  return stretches;
}

/// Combines the stereo and laser motions of each step.
class StepFusion {
 public:
  StepFusion(const SharedConstants& shared, double spread) : shared_(shared), spread_(spread) {}

  /// `inflation`: factor on both covariances, at least 1. `laser`: null if only stereo has measured the step.
  RelativePose fuse(const RelativePose& step, const IntervalMotion& stereo, const IntervalMotion* laser,
                    StepSource source, double inflation) const {
    const double factor = spread_ * inflation;
    RelativePose fused = step;
    fused.source = "fused";
    Matrix6d gain = Matrix6d::Zero();  // weight of the laser
    if (source == StepSource::Laser) gain.setIdentity();
    // The gain is computed from the drifts: errors of the end poses cancel from step to step.
    if (source == StepSource::Both)
      gain = SmallCholesky<6>(Matrix6d(stereo.drift + laser->drift)).solve(stereo.drift).transpose();
    const Matrix6d rest = Matrix6d::Identity() - gain;
    const Pose by_stereo = shared_.correctedStereo(stereo);
    fused.T_from_to = by_stereo;
    fused.covariance = transformCovariance(rest, step.covariance);
    fused.drift_covariance = transformCovariance(rest, stereo.drift);
    Eigen::MatrixXd sensitivity = rest * shared_.stereoSensitivity(stereo);
    if (laser != nullptr) {
      fused.T_from_to = boxPlus(by_stereo, gain * boxMinus(shared_.correctedLaser(*laser), by_stereo));
      fused.covariance += transformCovariance(gain, laser->covariance);
      fused.drift_covariance += transformCovariance(gain, laser->drift);
      sensitivity += gain * shared_.laserSensitivity(*laser);
    }
    fused.covariance *= factor;
    fused.drift_covariance *= factor;
    setConstants(sensitivity * shared_.factor(), fused);
    return fused;
  }

 private:
  /// Sets the jointly estimated constants as independent errors, each of standard deviation 1.
  static void setConstants(const Eigen::MatrixXd& sensitivity, RelativePose& fused) {
    fused.constants.clear();
    for (Eigen::Index k = 0; k < sensitivity.cols(); ++k)
      fused.constants.push_back({"fusion_" + std::to_string(k + 1), 0.0, 0.0, 1.0, Vector6d(sensitivity.col(k))});
  }

  const SharedConstants& shared_;
  double spread_;
};

/// Returns the status of a step measured by one of the two odometries only.
Status fusedStatus(const Status& stereo, StepSource source) {
  if (source != StepSource::Laser) return stereo;
  return {Health::Degraded, stereo.reason,
          "by LiDAR odometry only" + (stereo.sentence.empty() ? "" : ": " + stereo.sentence)};
}

}  // namespace

FusedOdometry fuseOdometry(const std::vector<RelativePose>& stereo, const std::vector<RelativePose>& laser,
                           const Vector3d& p_base_lidar, const FusionOptions& options) {
  const InterpolatedOdometry by_stereo(stereo, options.acceleration, options.angular_acceleration),
      by_laser(laser, options.acceleration, options.angular_acceleration);
  const std::vector<std::optional<IntervalMotion>> motions = motionsByLaser(stereo, by_laser);
  FusedOdometry result;
  for (std::size_t i = 0; i < stereo.size(); ++i)
    result.sources.push_back(findSource(stereo[i], motions[i].has_value()));
  std::vector<Stretch> stretches = findStretches(stereo, result.sources, by_stereo, by_laser);
  const SharedConstants shared(stretches, stereo, laser, p_base_lidar, options);
  std::vector<double> inflation(stereo.size(), 1.0);
  for (const Stretch& stretch : stretches) {
    if (stretch.statistic <= kConflict * shared.spread()) continue;
    const Pose a = shared.correctedStereo(stretch.stereo), b = shared.correctedLaser(stretch.laser);
    result.conflicts.push_back(
        {stretch.from, stretch.to, stretch.statistic, distanceBetween(a, b), angleBetween(a, b)});
    for (std::size_t i = stretch.first_step; i < stretch.end_step; ++i) inflation[i] = stretch.statistic / 6.0;
  }
  const StepFusion fusion(shared, shared.spread());
  for (std::size_t i = 0; i < stereo.size(); ++i) {
    const std::optional<IntervalMotion> own = by_stereo.over(stereo[i].from, stereo[i].to);
    result.steps.push_back(fusion.fuse(stereo[i], own.value_or(IntervalMotion()), motions[i] ? &*motions[i] : nullptr,
                                       result.sources[i], inflation[i]));
    result.steps.back().status = fusedStatus(stereo[i].status, result.sources[i]);
  }
  result.spread = shared.spread();
  if (!stretches.empty()) result.shared = shared.list();
  return result;
}

}  // namespace urban_nav_core
