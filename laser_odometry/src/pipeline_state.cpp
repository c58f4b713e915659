// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline.hpp"

#include <cmath>

#include "status.hpp"
#include "urban_nav_core/types/error.hpp"

namespace laser_odometry {

using urban_nav_core::Health;

namespace {

constexpr const char* kStateName = "laser_odometry";
constexpr std::uint32_t kStateVersion = 3;
// Limits of a vehicle that drives over a kerb: a registration beyond them is rejected.
constexpr double kLargestAcceleration = 50.0;  // m/s^2
constexpr double kLargestTurn = 15.0;          // rad/s^2
constexpr double kGap = 1.7;                   // typical times between sweeps
constexpr double kOverlap = 0.7;               // minimum time between sweeps, of the duration of a sweep

}  // namespace

void Pipeline::assess(const Aligned& aligned, const SweepPoints& points, const urban_nav_core::Sweep& sweep,
                      const Prediction& prediction, LaserPose& result) const {
  const Registration& registration = aligned.registration;
  result.status = statusOfRegistration(registration, points, registration.T_odom_base, parameters_);
  Statistics& figures = result.statistics;
  figures.patches = static_cast<int>(registration.matches.size());
  figures.iterations = aligned.iterations;
  figures.residual_m = registration.residual_m;
  double used = 0.0, moving = 0.0;
  for (const PatchMatch& match : registration.matches) {
    (match.robust > 0.1 ? used : moving) += match.count;
  }
  figures.used = static_cast<int>(used);
  figures.moving = static_cast<int>(moving);
  if (result.status.health == Health::Lost) return;
  if (!isPlausible(registration, prediction)) {
    result.status = statusOfJump(prediction.T_last_now, T_odom_base_.inverse() * registration.T_odom_base);
    return;
  }
  if (lost_ > 0 && result.status.health == Health::Ok) result.status.health = Health::Recovered;
  if (result.status.reason != 0) return;
  if (usual_s_ > 0.0 && prediction.seconds > kGap * usual_s_) {
    result.status.reason = static_cast<int>(Reason::Gap);
    result.status.sentence = std::to_string(static_cast<int>(1e3 * prediction.seconds)) +
                             " ms since the previous sweep, typically " +
                             std::to_string(static_cast<int>(1e3 * usual_s_)) + " ms: sweeps are missing";
  } else if (sweep.times == urban_nav_core::Sweep::Times::Measured && prediction.seconds < kOverlap * sweep.duration) {
    result.status.reason = static_cast<int>(Reason::Overlap);
    result.status.sentence = std::to_string(static_cast<int>(1e3 * prediction.seconds)) + " ms between sweeps of " +
                             std::to_string(static_cast<int>(1e3 * sweep.duration)) + " ms: sweeps overlap";
  }
}

bool Pipeline::isPlausible(const Registration& registration, const Prediction& prediction) const {
  // A measured prior may be more accurate than its covariance; at the start the motion is unknown.
  if (prediction.is_measured || !motion_.isKnown() || first_.used > 0) return true;
  const Vector6d d = urban_nav_core::boxMinus(T_odom_base_.inverse() * registration.T_odom_base, prediction.T_last_now);
  const double span = prediction.seconds * (prediction.seconds + usual_s_ * lost_ + motion_.unobservedSeconds());
  return d.head<3>().norm() <= kLargestAcceleration * span && d.tail<3>().norm() <= kLargestTurn * span;
}

std::vector<MapPoint> Pipeline::localMap() const {
  std::vector<MapPoint> points;
  // Points of a planar laser are projected to z = 0.
  const Vector3d lift(0.0, 0.0, space_ == MotionSpace::Planar ? T_base_lidar_.t().z() : 0.0);
  for (int level = 0; level < map_.levels(); ++level) {
    for (const MapCell& cell : map_.cells(level)) {
      // Replaced by a plane of a finer level at the same position.
      bool is_covered = false;
      for (int finer = 0; finer < level && !is_covered; ++finer) is_covered = map_.hasPlane(cell, finer);
      const Plane plane = map_.findPlane(cell);
      if (is_covered || !plane.usable) continue;
      points.push_back({Vector3d(plane.mean + lift).cast<float>(), plane.normal.cast<float>(),
                        static_cast<float>(std::sqrt(plane.variance))});
    }
  }
  return points;
}

std::string Pipeline::fingerprint() const {
  std::string text;
  for (const auto& row : table().rows()) text += row.name + "=" + printValue(table().get(parameters_, row.name)) + ";";
  urban_nav_core::Archive archive;
  Pose place = T_base_lidar_;
  archive(place);
  if (scanner_ != Scanner::Spatial) text += "scanner=" + std::to_string(static_cast<int>(scanner_)) + ";";
  return text + archive.take();
}

void Pipeline::archive(urban_nav_core::Archive& archive) {
  archive(map_, motion_, errors_, gap_, agreement_, sweep_, started_, stamp_, T_odom_base_, end_covariance_, has_step_,
          drift_, covariance_, usual_s_, lost_, pruned_at_, first_);
  archive.require(sweep_ >= 0 && lost_ >= 0 && usual_s_ >= 0.0, "negative number");
}

std::string Pipeline::state() const {
  urban_nav_core::Archive archive;
  std::string known = fingerprint();
  archive(known);
  const_cast<Pipeline*>(this)->archive(archive);  // writes only
  return urban_nav_core::seal(kStateName, kStateVersion, archive.take());
}

void Pipeline::restore(std::string_view state) {
  urban_nav_core::Archive archive(urban_nav_core::unseal(kStateName, kStateVersion, state), "state of laser_odometry");
  std::string known;
  archive(known);
  if (known != fingerprint())
    throw urban_nav_core::UserError("state of laser_odometry", "written with other parameters or another T_base_lidar",
                                    "the parameters and the mounting that it was written with");
  this->archive(archive);
  archive.finish();
}

}  // namespace laser_odometry
