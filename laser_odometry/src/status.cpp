// SPDX-License-Identifier: BSD-3-Clause
#include "status.hpp"

#include <cmath>
#include <cstdio>
#include <string>

namespace laser_odometry {

using urban_nav_core::Health;
using urban_nav_core::Status;

namespace {

constexpr int kFewestPoints = 200;       // returns required for a registration
constexpr int kFewestPlanarPoints = 30;  // of a planar laser: a twelfth of a revolution with 1 deg between beams
constexpr double kCoveredShare = 0.25;   // share of returns nearer than min_range
constexpr double kAgreeing = 3.0;        // standard deviations
constexpr double kLeastAgreeing = 0.5;   // share of the matches
// Minimum of Registration::covered if directions are free: below it, the map is of another place, and constrains
// directions only that all places constrain, such as the height above the ground.
constexpr double kLeastCovered = 1.0 / 3.0;

Status make(Health health, Reason reason, const std::string& sentence) {
  return {health, static_cast<int>(reason), sentence};
}

std::string number(double value, const char* format) {
  char text[32];
  std::snprintf(text, sizeof(text), format, value);
  return text;
}

std::optional<Status> findCover(const SweepPoints& points, const Parameters& parameters, Health health) {
  if (points.valid == 0 || points.near < kCoveredShare * points.valid) return std::nullopt;
  return make(health, Reason::Covered,
              number(100.0 * points.near / points.valid, "%.0f") + " % of the returns are nearer than " +
                  number(parameters.min_range, "%g") + " m: the robot itself, or an object that covers the LiDAR");
}

}  // namespace

const char* toString(Reason reason) {
  switch (reason) {
    case Reason::None: return "";
    case Reason::NoPoints: return "no_points";
    case Reason::TooFewPoints: return "too_few_points";
    case Reason::Covered: return "covered";
    case Reason::FreeDirection: return "free_direction";
    case Reason::Mismatch: return "mismatch";
    case Reason::BadStamp: return "bad_stamp";
    case Reason::Gap: return "gap";
    case Reason::Overlap: return "overlap";
    case Reason::Planar: return "planar";
    case Reason::Prior: return "prior";
  }
  return "unknown";
}

std::string describeDirection(const Vector6d& direction) {
  const bool is_turn = direction.tail<3>().norm() > direction.head<3>().norm();
  const Eigen::Vector3d axis = (is_turn ? direction.tail<3>() : direction.head<3>()).normalized();
  const std::string word = is_turn ? "about " : "along ";
  for (int i = 0; i < 3; ++i)
    if (std::abs(axis[i]) > 0.985) return word + "xyz"[i];  // within 10 deg
  return word + "(" + number(axis.x(), "%.2f") + ", " + number(axis.y(), "%.2f") + ", " + number(axis.z(), "%.2f") +
         ")";
}

Status statusOfStart(const SweepPoints& points, const Parameters& parameters, MotionSpace space) {
  if (const std::optional<Status> few = findTooFewPoints(points, space)) return *few;
  return findCover(points, parameters, Health::Degraded).value_or(Status{});
}

Status statusOfRestart(const SweepPoints& points, const Parameters& parameters, MotionSpace space) {
  Status status = statusOfStart(points, parameters, space);
  if (status.health == Health::Lost) return status;
  return make(Health::Lost, Reason::Mismatch, "local map restarted: the motion is predicted");
}

Status statusOfStamp(urban_nav_core::StampNs last, urban_nav_core::StampNs now) {
  return make(Health::Degraded, Reason::BadStamp,
              "reference time " + urban_nav_core::printStamp(now) + " s is not later than the previous one, " +
                  urban_nav_core::printStamp(last) + " s: dropped");
}

Status statusOfJump(const Pose& predicted, const Pose& registered) {
  return make(Health::Lost, Reason::Mismatch,
              "registered " + number(urban_nav_core::distanceBetween(predicted, registered), "%.2f") + " m and " +
                  number(urban_nav_core::angleBetween(predicted, registered) * 180.0 / M_PI, "%.1f") +
                  " deg from the predicted pose: implausible acceleration");
}

std::optional<Status> findTooFewPoints(const SweepPoints& points, MotionSpace space) {
  if (points.valid == 0) return make(Health::Lost, Reason::NoPoints, "no valid return: NaN, or ranges of zero");
  const int left = points.used, fewest = space == MotionSpace::Planar ? kFewestPlanarPoints : kFewestPoints;
  if (left >= fewest) return std::nullopt;
  return make(
      Health::Lost, Reason::TooFewPoints,
      "too few returns in range: " + std::to_string(left) + ", at least " + std::to_string(fewest) + " required");
}

Status statusOfPlanar(Status status) {
  const std::string sentence = "planar motion only: height, roll and pitch are assumed, not measured";
  if (status.reason == static_cast<int>(Reason::None)) status.reason = static_cast<int>(Reason::Planar);
  status.sentence += (status.sentence.empty() ? "" : "; ") + sentence;
  return status;
}

Status statusOfPrior(Status status, const std::string& contradiction) {
  const std::string sentence = "the prior of the motion is left out: it contradicts the sweeps" +
                               (contradiction.empty() ? "" : ", " + contradiction);
  if (status.reason == static_cast<int>(Reason::None)) status.reason = static_cast<int>(Reason::Prior);
  status.sentence += (status.sentence.empty() ? "" : "; ") + sentence;
  return status;
}

Status statusOfRegistration(const Registration& registration, const SweepPoints& points, const Pose& T_odom_base,
                            const Parameters& parameters) {
  if (const std::optional<Status> few = findTooFewPoints(points, registration.free.space)) return *few;
  const int matches = static_cast<int>(registration.matches.size());
  if (!registration.solved || matches < parameters.lost_patches)
    return make(Health::Lost, Reason::TooFewPoints,
                "too few surface patches: " + std::to_string(matches) + " match the local map, at least " +
                    std::to_string(parameters.lost_patches) + " required, of " + std::to_string(points.valid) +
                    " returns");
  double agreeing = 0.0;
  for (const PatchMatch& match : registration.matches)
    if (std::abs(match.residual) * std::sqrt(match.row.weight) < kAgreeing) agreeing += 1.0;
  if (agreeing < kLeastAgreeing * matches)
    return make(Health::Lost, Reason::Mismatch,
                "only " + number(100.0 * agreeing / matches, "%.0f") + " % of the surface patches fit the local map");
  if (registration.free.isFree() && registration.covered < kLeastCovered)
    return make(Health::Lost, Reason::Mismatch,
                "only " + number(100.0 * registration.covered, "%.0f") +
                    " % of the near surface patches lie on the local map, and they do not constrain the motion");
  if (registration.free.isFree()) {
    const Matrix3d R = T_odom_base.R().transpose();
    std::string names;
    for (const Vector6d& v : registration.free.directions) {
      Vector6d turned;
      turned << R * v.head<3>(), R * v.tail<3>();
      names += (names.empty() ? "" : ", ") + describeDirection(turned);
    }
    return make(Health::Degraded, Reason::FreeDirection,
                "the surroundings do not constrain the motion " + names + ": taken from the prior");
  }
  if (const std::optional<Status> cover = findCover(points, parameters, Health::Degraded)) return *cover;
  if (matches < parameters.degraded_patches)
    return make(Health::Degraded, Reason::TooFewPoints,
                "few surface patches: " + std::to_string(matches) + " match the local map, at least " +
                    std::to_string(parameters.degraded_patches) + " wanted, of " + std::to_string(points.valid) +
                    " returns");
  return {};
}

}  // namespace laser_odometry
