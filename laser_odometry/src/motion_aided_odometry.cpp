// SPDX-License-Identifier: BSD-3-Clause
#include "laser_odometry/motion_aided_odometry.hpp"

#include <cmath>
#include <utility>

#include "motion.hpp"
#include "urban_nav_core/io/archive_types.hpp"
#include "urban_nav_core/motion/motion_sensors.hpp"

namespace laser_odometry {

using urban_nav_core::Health;
using urban_nav_core::MeasuredStep;
using urban_nav_core::MotionInput;
using urban_nav_core::Reckoned;
using urban_nav_core::StampNs;
using urban_nav_core::Sweep;

namespace {

constexpr const char* kAidedStateName = "laser odometry with motion sensors";
constexpr std::uint32_t kAidedStateVersion = 2;
// Squared cosine between the direction of travel, or the rotations, and the free directions up to which a pose is
// measured: free directions vary by about 5 deg.
constexpr double kMeasured = 0.03;
// Time between sweeps that leave a direction free and those from which sensors are calibrated, s: surfaces that fade
// from view are few and far, and their errors exceed their covariances. As long as the window of the images.
constexpr double kFading = 1.0;

urban_nav_core::MotionSensors makeSensors() {
  urban_nav_core::MotionSensors::Options options;
  options.reference = "sweeps";
  options.uses_untested_wheels = true;
  return urban_nav_core::MotionSensors(options);
}

/// Parts of the motion that a pose measures.
struct Measured {
  bool turn = true, forward = true;
};

Measured measuredBy(const LaserPose& pose) {
  if (pose.status.health == Health::Lost) return {false, false};
  const Matrix6d free = projectorOnto(pose.free_directions);
  return {free.diagonal().tail<3>().sum() < kMeasured, free(0, 0) < kMeasured};
}

}  // namespace

class MotionAidedOdometry::Implementation {
 public:
  Implementation(const Parameters& parameters, const Pose& T_base_lidar, Scanner scanner)
      : odometry_(std::in_place, parameters, T_base_lidar, scanner), sensors_(makeSensors()) {}

  Implementation(const Parameters& parameters, const Pose& T_base_lidar, std::string_view state, Scanner scanner)
      : sensors_(makeSensors()) {
    urban_nav_core::Archive archive(urban_nav_core::unseal(kAidedStateName, kAidedStateVersion, state),
                                    std::string("state of ") + kAidedStateName);
    std::string odometry;
    archive(odometry);
    odometry_.emplace(parameters, T_base_lidar, odometry, scanner);
    this->archive(archive);
    archive.finish();
  }

  LaserPose process(const Sweep& sweep, const std::vector<MotionInput>& inputs) {
    sensors_.add(inputs);
    const std::optional<MotionPrior> prior = predict(sweep);
    LaserPose pose = odometry_->process(sweep, prior);
    if (pose.accepted) learn(pose);
    return pose;
  }

  std::string state() const {
    urban_nav_core::Archive archive;
    std::string odometry = odometry_->state();
    archive(odometry);
    const_cast<Implementation*>(this)->archive(archive);  // writes only
    return urban_nav_core::seal(kAidedStateName, kAidedStateVersion, archive.take());
  }

  const LaserOdometry& odometry() const { return *odometry_; }
  const urban_nav_core::MotionSensors& sensors() const { return sensors_; }

 private:
  std::optional<MotionPrior> predict(const Sweep& sweep) const {
    if (frames_ == 0 || sweep.reference <= stamp_) return std::nullopt;
    const std::optional<Reckoned> step = sensors_.predict(stamp_, sweep.reference, q_odom_base_, forward_unmeasured_);
    if (!step) return std::nullopt;
    MotionPrior prior;
    prior.step.from = stamp_;
    prior.step.to = sweep.reference;
    prior.step.source = !step->has_translation ? "gyroscope" : step->has_gyroscope ? "gyroscope, wheels" : "wheels";
    prior.step.T_from_to = step->T_from_to;
    prior.step.covariance = step->covariance;
    prior.alone = step->covariance_alone;
    prior.has_translation = step->has_translation;
    prior.has_tilt = step->has_gyroscope;
    if (sweep.times == Sweep::Times::Measured) prior.within = twistWithin(sweep, step->has_translation);
    return prior;
  }

  std::optional<Vector6d> twistWithin(const Sweep& sweep, bool has_translation) const {
    if (sweep.beams.empty() || !(sweep.duration > 0.0)) return std::nullopt;
    const StampNs begin = sweep.beams.front().stamp, end = sweep.beams.back().stamp;
    const double seconds = urban_nav_core::secondsBetween(begin, end);
    if (!(seconds > 0.0)) return std::nullopt;
    const std::optional<Reckoned> motion = sensors_.predict(begin, end, q_odom_base_);
    if (!motion || motion->has_translation != has_translation) return std::nullopt;
    return urban_nav_core::logSe3(motion->T_from_to) / seconds;
  }

  void learn(const LaserPose& pose) {
    const Measured measured = measuredBy(pose);
    const double seconds = urban_nav_core::secondsBetween(pose.step.from, pose.step.to);
    urban_nav_core::MeasuredStep step;
    step.frame = frames_++;
    step.stamp = pose.stamp;
    step.step = pose.step;
    step.q_odom_base = pose.T_odom_base.q();
    step.health = pose.status.health == Health::Lost ? Health::Lost : Health::Ok;
    step.measures_turn = measured.turn && measured_.turn;
    step.measures_forward = measured.forward && measured_.forward;
    sensors_.addFrame(step.frame, seconds, measured.turn, false);
    if (step.health == Health::Ok && !is_lost_ && seconds > 0.0) sensors_.check(step);
    settle(step, measured);
    forward_unmeasured_ = measured.forward ? 0.0 : forward_unmeasured_ + seconds;
    measured_ = measured;
    is_lost_ = step.health == Health::Lost;
    stamp_ = pose.stamp;
    q_odom_base_ = pose.T_odom_base.q();
  }

  /// Calibrates the sensors by the steps that are far enough from sweeps with free directions.
  void settle(MeasuredStep step, const Measured& measured) {
    turn_free_ = measured.turn ? turn_free_ : step.stamp;
    forward_free_ = measured.forward ? forward_free_ : step.stamp;
    pending_.push_back(std::move(step));
    const auto fades = [](StampNs free, StampNs stamp) {
      return free != 0 && std::abs(urban_nav_core::secondsBetween(free, stamp)) < kFading;
    };
    for (MeasuredStep& each : pending_) {
      each.measures_turn = each.measures_turn && !fades(turn_free_, each.stamp);
      each.measures_forward = each.measures_forward && !fades(forward_free_, each.stamp);
    }
    const StampNs newest = pending_.back().stamp;
    auto next = pending_.begin();
    for (; next != pending_.end() && urban_nav_core::secondsBetween(next->stamp, newest) >= kFading; ++next)
      sensors_.learn(*next);
    pending_.erase(pending_.begin(), next);
  }

  void archive(urban_nav_core::Archive& archive) {
    Pose last(q_odom_base_, Vector3d::Zero());
    archive(sensors_, frames_, stamp_, last, measured_.turn, measured_.forward, is_lost_, forward_unmeasured_);
    archive(turn_free_, forward_free_, pending_);
    q_odom_base_ = last.q();
    archive.require(frames_ >= 0 && forward_unmeasured_ >= 0.0, "negative number");
  }

  std::optional<LaserOdometry> odometry_;
  urban_nav_core::MotionSensors sensors_;
  std::int64_t frames_ = 0;
  StampNs stamp_ = 0;  ///< of the last accepted sweep
  urban_nav_core::Quaterniond q_odom_base_ = urban_nav_core::Quaterniond::Identity();
  Measured measured_;
  bool is_lost_ = false;
  StampNs turn_free_ = 0, forward_free_ = 0;  ///< newest sweep that left these parts free; 0: none
  std::vector<MeasuredStep> pending_;         ///< in order of time
  double forward_unmeasured_ = 0.0;           ///< s before the last sweep
};

MotionAidedOdometry::MotionAidedOdometry(const Parameters& parameters, const Pose& T_base_lidar, Scanner scanner)
    : implementation_(std::make_unique<Implementation>(parameters, T_base_lidar, scanner)) {}

MotionAidedOdometry::MotionAidedOdometry(const Parameters& parameters, const Pose& T_base_lidar, std::string_view state,
                                         Scanner scanner)
    : implementation_(std::make_unique<Implementation>(parameters, T_base_lidar, state, scanner)) {}

MotionAidedOdometry::~MotionAidedOdometry() = default;
MotionAidedOdometry::MotionAidedOdometry(MotionAidedOdometry&&) noexcept = default;
MotionAidedOdometry& MotionAidedOdometry::operator=(MotionAidedOdometry&&) noexcept = default;

LaserPose MotionAidedOdometry::process(const Sweep& sweep, const std::vector<MotionInput>& inputs) {
  return implementation_->process(sweep, inputs);
}

const urban_nav_core::MotionEstimates& MotionAidedOdometry::motion() const {
  return implementation_->sensors().estimates();
}

std::vector<MapPoint> MotionAidedOdometry::localMap() const { return implementation_->odometry().localMap(); }
std::string MotionAidedOdometry::state() const { return implementation_->state(); }

}  // namespace laser_odometry
