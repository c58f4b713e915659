// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline.hpp"
#include "status.hpp"

namespace laser_odometry {

using urban_nav_core::Health;

namespace {

constexpr double kUnmeasuredPart = 0.05;  // least part of a free direction that counts, 1 rad as 1 m

}  // namespace

std::optional<MotionPrior> Pipeline::complete(const std::optional<MotionPrior>& prior, double seconds) const {
  if (!prior || !(seconds > 0.0) || !prior->step.T_from_to.isFinite() || !prior->step.covariance.allFinite())
    return std::nullopt;
  if (prior->alone && !prior->alone->allFinite()) return std::nullopt;
  if (prior->has_translation) return prior;
  MotionPrior whole = *prior;
  Vector6d twist = motion_.twist();
  twist.tail<3>() = urban_nav_core::logSo3(prior->step.T_from_to.q()) / seconds;
  whole.step.T_from_to = urban_nav_core::expSe3(twist * seconds);
  const auto merge = [&](const Matrix6d& predicted, const Matrix6d& measured) {
    Matrix6d merged = Matrix6d::Zero();
    merged.topLeftCorner<3, 3>() = predicted.topLeftCorner<3, 3>();
    merged.bottomRightCorner<3, 3>() = measured.bottomRightCorner<3, 3>();
    return merged;
  };
  whole.step.covariance = merge(motion_.predictionCovariance(seconds), prior->step.covariance);
  whole.alone = merge(motion_.stepCovariance(seconds), prior->alone.value_or(prior->step.covariance));
  return whole;
}

std::vector<Vector6d> Pipeline::withoutMeasured(const std::vector<Vector6d>& free, const Prediction& prediction) {
  if (!prediction.has_prior) return free;
  std::vector<Vector6d> rest;
  for (const Vector6d& direction : free) {
    Vector6d part = direction;
    if (prediction.is_measured) part.head<3>().setZero();
    if (prediction.is_tilt_measured) part.segment<2>(3).setZero();
    part[5] = 0.0;
    if (part.norm() > kUnmeasuredPart * direction.norm()) rest.push_back(part);
  }
  return rest;
}

Pipeline::Aligned Pipeline::alignWithPrior(const SweepPoints& points, const urban_nav_core::Sweep& sweep,
                                           Prediction& prediction) {
  Aligned aligned = align(points, prediction, T_odom_base_ * prediction.T_last_now);
  if (!prediction.has_prior || !motion_.isKnown() || !aligned.registration.solved) return aligned;
  const Registration& registration = aligned.registration;
  ComparedStep step;
  step.seconds = prediction.seconds;
  step.by_sweeps = T_odom_base_.inverse() * registration.T_odom_base;
  step.by_prior = prediction.is_measured ? prediction.T_last_now : Pose(prediction.T_last_now.q(), step.by_sweeps.t());
  step.covariance_by_sweeps = end_covariance_;
  step.covariance_by_prior = prediction.covariance;
  const std::vector<Vector6d> free = freeTwists(registration.free, registration.T_odom_base.R().transpose());
  if (!agreement_.isFarFrom(step, free)) return aligned;
  prediction = predict(sweep, std::nullopt);
  return align(points, prediction, T_odom_base_ * prediction.T_last_now);
}

void Pipeline::comparePrior(const std::optional<MotionPrior>& prior, const Prediction& prediction, LaserPose& result) {
  // Free directions of the result are scaled by the lever of the surfaces; as twists their span is nearly the same.
  const std::vector<Vector6d>& free = result.free_directions;
  if (!prior || result.status.health == Health::Lost || first_.used > 0 || !motion_.isKnown()) {
    agreement_.interrupt(free);
  } else {
    const bool is_planar = space_ == MotionSpace::Planar;
    ComparedStep step;
    step.seconds = prediction.seconds;
    step.by_sweeps = result.step.T_from_to;
    step.by_prior = is_planar ? toPlanar(prior->step.T_from_to) : prior->step.T_from_to;
    if (!prior->has_translation) step.by_prior = Pose(step.by_prior.q(), step.by_sweeps.t());
    step.covariance_by_sweeps = result.step.covariance;
    step.covariance_by_prior = prior->step.covariance;
    agreement_.add(step, free);
  }
  if (prior && !prediction.has_prior) result.status = statusOfPrior(std::move(result.status), agreement_.sentence());
}

}  // namespace laser_odometry
