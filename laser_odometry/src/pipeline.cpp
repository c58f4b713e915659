// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline.hpp"

#include <algorithm>
#include <cmath>

#include "status.hpp"
#include "urban_nav_core/geometry/covariance_frames.hpp"

namespace laser_odometry {

using urban_nav_core::Health;
using urban_nav_core::Sweep;

namespace {

constexpr double kLongestSweep = 1.0;    // s from the reference: a sweep takes 10 ms to 1 s
constexpr std::int32_t kLostLimit = 5;   // consecutive predicted sweeps after which the map is restarted
constexpr double kPruneStep = 5.0;       // m between prunings of the map
constexpr double kRangeScale = 5e-4;     // relative error common to all ranges: the 2 cm stated by manufacturers, at 40
                                         // m
constexpr double kReach = 60.0;          // edges of a cube: distance at which beams of 0.5 deg are half an edge apart
constexpr double kSegment = 0.5;         // edges of a cube: largest distance between returns of a segment
constexpr int kStartRounds = 4;          // rounds of mutual deskewing of the first two sweeps
constexpr double kConsecutive = 2.0;     // sweep durations between the reference times of consecutive sweeps, at most
constexpr double kStartStep = 0.3;       // m between start positions of the second sweep
constexpr double kStartSpeed = 40.0;     // m/s, maximum speed of the search
constexpr double kStartSteps = 12.0;     // maximum number, forward and backward
constexpr double kUnknownStart = 0.4;    // m, errors at the surfaces with unknown velocity,
constexpr double kPredictedStart = 0.1;  // and after a prediction
constexpr double kBlurred = 0.25;        // m between sweeps, error of the speed by which surfaces blur: half a cube
constexpr double kStartGain = 1.005;     // required gain of the fit over a standing start

/// Returns a covariance of a step in the axes of odom: d_odom = J2^-1 d_step.
Matrix6d inOdom(const Matrix6d& covariance, const Pose& T_odom_base) {
  const Matrix3d R = T_odom_base.R();
  Matrix6d to_odom = Matrix6d::Zero();
  to_odom.topLeftCorner<3, 3>() = to_odom.bottomRightCorner<3, 3>() = R;
  return to_odom * covariance * to_odom.transpose();
}

}  // namespace

Pipeline::Pipeline(const Parameters& parameters, const Pose& T_base_lidar, Scanner scanner)
    : scanner_(scanner),
      space_(scanner == Scanner::Planar ? MotionSpace::Planar : MotionSpace::Spatial),
      parameters_(toScannerParameters(parameters, space_)),
      T_base_lidar_(T_base_lidar),
      map_(parameters_.cell, parameters_.levels, kReach * parameters_.cell, space_),
      motion_(parameters_),
      errors_(space_) {
  if (space_ == MotionSpace::Planar) end_covariance_ = floorOfPose(parameters_);
}

SweepPoints Pipeline::collect(const Sweep& sweep) const {
  PointsRule rule;
  rule.min_range = parameters_.min_range;
  rule.max_range = parameters_.max_range;
  rule.longest_s = kLongestSweep;
  rule.length = kSegment * parameters_.cell;
  rule.space = space_;
  return collectPoints(sweep, T_base_lidar_, rule);
}

LaserPose Pipeline::process(const Sweep& sweep, const std::optional<MotionPrior>& prior) {
  if (started_ && sweep.reference <= stamp_) return drop(sweep);
  const Pose T_odom_last = T_odom_base_;
  LaserPose result;
  result.stamp = sweep.reference;
  const std::optional<MotionPrior> whole =
      started_ ? complete(prior, urban_nav_core::secondsBetween(stamp_, sweep.reference)) : std::nullopt;
  if (whole) agreement_.follow(whole->step.source);
  Prediction prediction = predict(sweep, agreement_.isLeftOut() ? std::nullopt : whole);
  const SweepPoints points = collect(sweep);
  result.statistics.points = points.valid;
  result.statistics.near = points.near;
  result.statistics.deskewed = parameters_.deskew && points.last_s > points.first_s;
  result.step.from = started_ ? stamp_ : sweep.reference;
  result.step.to = sweep.reference;
  result.step.source = "laser_odometry";
  if (map_.empty()) {
    continueByPrediction(prediction, result);
    beginMap(points, knownMotion());
    result.status =
        started_ ? statusOfRestart(points, parameters_, space_) : statusOfStart(points, parameters_, space_);
  } else {
    const Aligned aligned =
        first_.used == 0 ? alignWithPrior(points, sweep, prediction) : alignSecond(points, prediction);
    assess(aligned, points, sweep, prediction, result);
    if (result.status.health == Health::Lost) {
      if (first_.used > 0) map_.clear();  // map of a sweep with unknown velocity
      first_ = SweepPoints();
      continueByPrediction(prediction, result);
      restartIfLost(points, prediction, result);
    } else {
      accept(aligned, points, prediction, sweep, result);
    }
  }
  if (started_) {
    comparePrior(whole, prediction, result);
    accumulate(T_odom_last, result.step);
  }
  result.T_odom_base = T_odom_base_;
  result.covariance = covariance_;
  if (space_ == MotionSpace::Planar && result.status.health != Health::Lost)
    result.status = statusOfPlanar(std::move(result.status));
  result.step.status = result.status;
  result.statistics.map_cells = static_cast<int>(map_.size());
  if (started_)
    usual_s_ = usual_s_ > 0.0 ? usual_s_ + 0.1 * (std::min(prediction.seconds, 2.0 * usual_s_) - usual_s_)
                              : prediction.seconds;
  stamp_ = sweep.reference;
  started_ = true;
  ++sweep_;
  return result;
}

void Pipeline::accumulate(const Pose& T_odom_last, const urban_nav_core::RelativePose& step) {
  using urban_nav_core::transformCovariance;
  // The covariance of a path is half of that of its first step, half of that of its last one, and the drifts
  // (RelativePose).
  if (!has_step_) drift_ = 0.5 * step.covariance;
  has_step_ = true;
  const urban_nav_core::Composition path = urban_nav_core::compose(T_odom_last, step.T_from_to);
  drift_ = transformCovariance(path.J1, drift_) + transformCovariance(path.J2, step.drift_covariance);
  covariance_ = drift_ + transformCovariance(path.J2, 0.5 * step.covariance);
}

LaserPose Pipeline::drop(const Sweep& sweep) const {
  LaserPose result;
  result.stamp = sweep.reference;
  result.accepted = false;
  result.T_odom_base = T_odom_base_;
  result.covariance = covariance_;
  result.step.covariance = kFirstCovariance * Matrix6d::Identity();
  result.step.from = result.step.to = stamp_;
  result.step.source = "laser_odometry";
  result.status = statusOfStamp(stamp_, sweep.reference);
  result.step.status = result.status;
  return result;
}

Pipeline::Prediction Pipeline::predict(const Sweep& sweep, const std::optional<MotionPrior>& prior) const {
  Prediction prediction;
  if (!started_) return prediction;
  prediction.seconds = urban_nav_core::secondsBetween(stamp_, sweep.reference);
  if (prior) {
    prediction.T_last_now = prior->step.T_from_to;
    prediction.covariance = prior->step.covariance;
    prediction.of_step = prior->alone.value_or(prior->step.covariance);
    prediction.is_measured = prior->has_translation;
    prediction.is_tilt_measured = prior->has_tilt;
    prediction.has_prior = true;
    prediction.within = prior->within;
  } else {
    prediction.T_last_now = motion_.predict(prediction.seconds);
    prediction.covariance = motion_.predictionCovariance(prediction.seconds);
    prediction.of_step = motion_.stepCovariance(prediction.seconds);
  }
  if (space_ == MotionSpace::Planar) {
    prediction.T_last_now = toPlanar(prediction.T_last_now);
    prediction.covariance =
        toPlanar(prediction.covariance) + floorOfStep(parameters_, prediction.T_last_now.t().norm());
  }
  return prediction;
}

SweepMotion Pipeline::knownMotion() const {
  return parameters_.deskew ? SweepMotion{motion_.twist(), Vector6d::Zero()} : SweepMotion();
}

void Pipeline::beginMap(const SweepPoints& points, const SweepMotion& motion) {
  map_.clear();
  first_ = points;
  map_.insert(transformed(T_odom_base_, deskew(points, motion)), T_odom_base_ * T_base_lidar_.t(), sweep_);
  pruned_at_ = T_odom_base_.t();
}

Pipeline::StartMotion Pipeline::startMotion(const Pose& T_first_second, double seconds, const SweepMotion& change) {
  // Mean velocity of the step, and velocities and accelerations of a motion of constant jerk at its ends.
  const Vector6d mean = urban_nav_core::logSe3(T_first_second) / seconds + seconds / 12.0 * change.acceleration;
  const Vector6d acceleration = change.twist / seconds;
  return {{mean - 0.5 * change.twist, acceleration - 0.5 * change.acceleration},
          {mean + 0.5 * change.twist, acceleration + 0.5 * change.acceleration}};
}

Pipeline::Aligned Pipeline::align(const SweepPoints& points, const Prediction& prediction, const Pose& guess,
                                  const std::optional<StartMotion>& start) {
  Aligned aligned;
  const Pose predicted = T_odom_base_ * prediction.T_last_now;
  aligned.registration.T_odom_base = guess;
  RegistrationOptions options;
  options.space = space_;
  options.iterations = parameters_.iterations;
  options.surface_sigma = parameters_.surface_sigma;
  const bool is_sure = prediction.is_measured && prediction.is_tilt_measured;
  options.coarse_level = is_sure ? 0 : 1;
  options.start_sigma = is_sure ? 0.0 : motion_.isKnown() ? kPredictedStart : kUnknownStart;
  const bool is_timed = parameters_.deskew && points.last_s > points.first_s && prediction.seconds > 0.0;
  if (is_timed) {
    options.velocity_sigma = parameters_.acceleration * prediction.seconds;
    options.rate_sigma = parameters_.angular_acceleration * prediction.seconds;
    options.acceleration_sigma = parameters_.acceleration;
    options.angular_acceleration_sigma = parameters_.angular_acceleration;
  }
  const int rounds = is_timed ? parameters_.rounds : 1;
  for (int round = 0; round < rounds; ++round) {
    if (is_timed) {
      const Pose T_last_now = T_odom_base_.inverse() * aligned.registration.T_odom_base;
      SweepMotion expected =
          start ? start->first : SweepMotion{motion_.sweepTwist(T_last_now, prediction.seconds), Vector6d::Zero()};
      if (prediction.within && !start && round == 0) {  // later, the estimated step is more accurate
        expected.twist[5] = (*prediction.within)[5];
        if (prediction.is_tilt_measured) expected.twist.segment<2>(3) = prediction.within->segment<2>(3);
        if (prediction.is_measured) expected.twist.head<3>() = prediction.within->head<3>();
      }
      if (round > 0) aligned.motion = aligned.motion + aligned.registration.motion_change;
      else aligned.motion = start ? start->second : expected;
      options.motion_offset = aligned.motion - expected;
    }
    aligned.segments = deskew(points, aligned.motion);
    const std::vector<Patch> patches = makePatches(aligned.segments, parameters_.cell);
    aligned.registration = registerPatches(patches, map_, predicted, aligned.registration.T_odom_base, options);
    aligned.iterations += aligned.registration.iterations;
    options.coarse_level = 0;
    options.start_sigma = 0.0;
  }
  return aligned;
}

Pose Pipeline::searchStart(const SweepPoints& points, const Prediction& prediction) {
  const std::vector<Patch> patches = makePatches(deskew(points, {}), parameters_.cell);
  RegistrationOptions options;
  options.space = space_;
  options.iterations = 6;
  options.surface_sigma = parameters_.surface_sigma;
  options.coarse_level = 0;
  options.start_sigma = kUnknownStart;
  const auto fit = [&](const Pose& pose) {
    double sum = 0.0;
    for (const PatchMatch& match : matchPatches(patches, map_, pose, {}, parameters_.surface_sigma, 0))
      sum += 1.0 / (1.0 + match.residual * match.residual * match.row.weight);
    return sum;
  };
  Pose best = registerPatches(patches, map_, T_odom_base_, T_odom_base_, options).T_odom_base;
  double most = kStartGain * fit(best);
  const int steps = static_cast<int>(std::min(kStartSteps, std::ceil(kStartSpeed * prediction.seconds / kStartStep)));
  for (int i = -steps; i <= steps; ++i) {
    if (i == 0) continue;
    const Pose guess = T_odom_base_ * Pose(Eigen::Quaterniond::Identity(), {i * kStartStep, 0.0, 0.0});
    const Registration found = registerPatches(patches, map_, guess, guess, options);
    if (found.free.leavesPositionFree()) continue;  // the position is that of the start
    const double sum = fit(found.T_odom_base);
    if (sum <= most) continue;
    most = sum;
    best = found.T_odom_base;
  }
  return best;
}

Pipeline::Aligned Pipeline::alignSecond(const SweepPoints& points, const Prediction& prediction) {
  const Pose T_odom_first = T_odom_base_;
  const bool is_known = prediction.is_measured || motion_.isKnown();
  Pose guess = is_known ? T_odom_base_ * prediction.T_last_now : searchStart(points, prediction);
  Aligned aligned;
  const SweepPoints first = first_;
  const double seconds = prediction.seconds;
  // Sweeps with a gap between them have no common acceleration.
  const bool are_consecutive = seconds < kConsecutive * (points.last_s - points.first_s);
  SweepMotion change;  // from the first sweep to the second
  for (int round = 0; round < kStartRounds; ++round) {
    std::optional<StartMotion> start;
    if (parameters_.deskew && seconds > 0.0) start = startMotion(T_odom_first.inverse() * guess, seconds, change);
    --sweep_;  // the map belongs to the previous sweep
    beginMap(first, start ? start->first : SweepMotion());
    ++sweep_;
    aligned = align(points, prediction, guess, start);
    guess = aligned.registration.T_odom_base;
    if (start && are_consecutive) change = aligned.motion + aligned.registration.motion_change - start->first;
  }
  return aligned;
}

Matrix6d Pipeline::skewCovariance(const Sweep& sweep) const {
  if (sweep.times == Sweep::Times::Deskewed) return Matrix6d::Zero();
  if (sweep.times == Sweep::Times::Measured && parameters_.deskew) return Matrix6d::Zero();
  // The returns of a sweep are spread evenly over its duration; their mean displacement is unknown.
  const double seconds = std::min(std::max(sweep.duration, 0.0), kLongestSweep);
  const Vector6d shift = motion_.twist() * seconds / std::sqrt(12.0);
  Matrix6d C = Matrix6d::Zero();
  C.topLeftCorner<3, 3>().diagonal().setConstant(shift.head<3>().squaredNorm());
  C.bottomRightCorner<3, 3>().diagonal().setConstant(shift.tail<3>().squaredNorm());
  return C;
}

void Pipeline::accept(const Aligned& aligned, const SweepPoints& points, const Prediction& prediction,
                      const Sweep& sweep, LaserPose& result) {
  const Registration& registration = aligned.registration;
  const Pose T_odom_last = T_odom_base_;
  T_odom_base_ = registration.T_odom_base;
  errors_.observe(registration.matches, sweep_);

  const urban_nav_core::Between step = urban_nav_core::between(T_odom_last, T_odom_base_);
  result.step.T_from_to = step.T_b_c;
  const bool is_planar = space_ == MotionSpace::Planar;
  const Matrix6d unit = covarianceOfObserved(registration.information, registration.free, Matrix6d::Zero());
  const auto alongFree = [&](const FreeSubspace& free, const Matrix6d& covariance) -> Matrix6d {
    const Matrix6d prior = inOdom(covariance, T_odom_last);
    return covarianceOfObserved(registration.information, free, prior) -
           covarianceOfObserved(registration.information, free, Matrix6d::Zero());
  };
  const FreeSubspace of_gap = gap_.average(registration.free);
  const Matrix6d along_free =
      alongFree(registration.free, prediction.of_step) + alongFree(of_gap, prediction.covariance - prediction.of_step);
  const Matrix6d floor = ErrorModel::endFloor();
  Matrix6d end = errors_.passing() * unit + floor + skewCovariance(sweep);
  const double age = errors_.age();
  const double share = 2.0 / (2.0 * age + 1.0);
  const double length = step.T_b_c.t().norm();
  Matrix6d drift = errors_.lasting() / age * unit + share * share * end + along_free + ErrorModel::driftFloor(length);
  if (is_planar) {
    end = toPlanar(end) + floorOfPose(parameters_);
    drift = toPlanar(drift) + floorOfStep(parameters_, length);
  }
  result.step.drift_covariance = urban_nav_core::transformCovariance(step.J2, drift);
  result.step.covariance = urban_nav_core::transformCovariance(step.J1, end_covariance_) +
                           urban_nav_core::transformCovariance(step.J2, end + drift + gap_.close(registration));
  gap_.extend(along_free, static_cast<std::int32_t>(registration.free.directions.size()), sweep_);
  end_covariance_ = end;
  Vector6d per_scale = Vector6d::Zero();
  per_scale.head<3>() = step.T_b_c.t();
  result.step.constants.push_back({"laser_scale", 0.0, 0.0, kRangeScale, per_scale});

  const Matrix3d R_base_odom = T_odom_base_.R().transpose();
  for (const Vector6d& direction : registration.free.directions) {
    Vector6d turned;
    turned << R_base_odom * direction.head<3>(), R_base_odom * direction.tail<3>();
    result.free_directions.push_back(turned.normalized());
  }
  StepEvidence evidence{result.step.covariance, {}};
  evidence.free = withoutMeasured(freeTwists(registration.free, R_base_odom), prediction);
  motion_.update(step.T_b_c, prediction.seconds, evidence);
  lost_ = 0;
  grow(aligned, points);
}

void Pipeline::grow(const Aligned& aligned, const SweepPoints& points) {
  const bool is_blurred =
      aligned.registration.free.leavesPositionFree() && motion_.stepCovariance(usual_s_)(0, 0) > kBlurred * kBlurred;
  if (!motion_.isKnown() || is_blurred) {  // sweeps with free directions would blur each other
    beginMap(points, knownMotion());
    return;
  }
  first_ = SweepPoints();
  map_.insert(transformed(T_odom_base_, aligned.segments), T_odom_base_ * T_base_lidar_.t(), sweep_);
  if ((T_odom_base_.t() - pruned_at_).norm() > kPruneStep) {
    map_.prune(T_odom_base_.t(), parameters_.map_range);
    pruned_at_ = T_odom_base_.t();
  }
}

void Pipeline::continueByPrediction(const Prediction& prediction, LaserPose& result) {
  result.step.T_from_to = prediction.T_last_now;
  result.step.covariance = started_ ? prediction.covariance : Matrix6d(kFirstCovariance * Matrix6d::Identity());
  if (started_ && space_ == MotionSpace::Planar) result.step.covariance += 2.0 * floorOfPose(parameters_);  // both ends
  result.step.drift_covariance = started_ ? prediction.covariance : Matrix6d(Matrix6d::Zero());
  const FreeSubspace all = findFreeSubspace({}, space_);
  if (started_)
    gap_.extend(inOdom(prediction.covariance, T_odom_base_), static_cast<std::int32_t>(all.directions.size()), sweep_);
  T_odom_base_ = T_odom_base_ * prediction.T_last_now;
  if (started_)
    motion_.update(prediction.T_last_now, prediction.seconds,
                   {prediction.covariance, withoutMeasured(all.directions, prediction)});
  if (started_) result.free_directions = all.directions;
}

void Pipeline::restartIfLost(const SweepPoints& points, const Prediction& prediction, LaserPose& result) {
  if (++lost_ < kLostLimit || points.used == 0) return;
  if (!prediction.is_measured) motion_ = MotionModel(parameters_);
  beginMap(points, knownMotion());
  result.status.sentence += "; local map restarted";
}

}  // namespace laser_odometry
