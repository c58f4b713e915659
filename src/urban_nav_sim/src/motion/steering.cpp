// SPDX-License-Identifier: BSD-3-Clause
#include "motion/steering.hpp"

#include <algorithm>
#include <cmath>

#include "motion/simulate_drive.hpp"
#include "noise/smooth.hpp"

namespace urban_nav_sim {
namespace {

constexpr double kArrived = 0.15;        // m before a stop
constexpr double kWindow = 1.2;          // m of the path searched for the next position of the robot
constexpr double kBetween = 0.02;        // m between the compared positions on the path
constexpr double kBend = 1.5;            // m over which curvature is measured
constexpr double kBendTurn = 0.75;       // rad/s in a bend
constexpr double kLeastBendSpeed = 0.3;  // m/s
constexpr double kBraking = 0.45;        // m/s^2
constexpr double kHaste = 0.65;          // m/s^2: change of the desired speed
constexpr double kLag = 0.4;             // s: delay of deceleration
constexpr double kCreep = 0.14;          // m/s: the robot turns around on a small arc
constexpr double kSteering = 2.2;        // 1/s
constexpr double kNever = 1e9;           // m: no further stop

double wrapped(double angle) { return std::remainder(angle, 2.0 * M_PI); }

}  // namespace

SteeringModel::SteeringModel(const RoutePath& way, double start, double wander, const Noise& hand)
    : way_(way),
      wander_(wander),
      along_(start),
      passed_(start),
      sideways_(hand.of("sideways")),
      haste_(hand.of("haste")) {}

// Beyond a stop the path continues straight, so that the robot arrives in its direction.
Eigen::Vector2d SteeringModel::wantedPlace(double s, double stop) const {
  const double on_path = std::min(s, stop - 1e-6);
  const Eigen::Vector2d forward = way_.direction(on_path), left(-forward.y(), forward.x());
  return way_.at(on_path) + (s - on_path) * forward + wander_ * smoothNoise(sideways_, s / 3.0) * left;
}

// Finds the nearest position on the path ahead, the later of two equally near ones (at a cut corner).
void SteeringModel::comeAlong(const SegwayState& state, double stop) {
  const double from = along_, to = std::min(from + kWindow, stop);
  double least = (way_.at(from) - state.position).norm();
  const auto places = static_cast<int>((to - from) / kBetween);
  for (int i = 0; i <= places; ++i) {
    const double s = from + i * kBetween;
    const double distance = (way_.at(s) - state.position).norm();
    if (distance > least) continue;
    least = distance;
    along_ = s;
  }
}

double SteeringModel::allowedSpeed(double stop) const {
  double allowed = std::min(way_.speed(along_), kTopSpeed) * (1.0 + 0.05 * smoothNoise(haste_, along_ / 8.0));
  for (int i = 0; i < 13; ++i) {
    const double ahead = 0.2 * i, s = along_ + ahead;
    if (s >= stop) break;
    const Eigen::Vector2d before = way_.direction(std::max(s - 0.5 * kBend, passed_));
    const Eigen::Vector2d after = way_.direction(std::min(s + 0.5 * kBend, stop - 1e-6));
    const double bend = std::abs(std::atan2(before.x() * after.y() - before.y() * after.x(), before.dot(after)));
    const double there = std::max(kBendTurn * kBend / std::max(bend, 1e-3), kLeastBendSpeed);
    allowed = std::min(allowed, std::sqrt(there * there + 2.0 * kBraking * ahead));
  }
  return std::min(allowed, kTopSpeed);
}

double SteeringModel::wantedSpeed(const SegwayState& state, double off_course, double stop) const {
  if (waiting_ > 0.0) return 0.0;
  const double facing = std::max(std::cos(off_course), 0.0);
  const double on_course = kCreep + (allowedSpeed(stop) - kCreep) * facing * facing;
  const double left = std::max(stop - along_ - kArrived - kLag * std::max(state.speed, 0.0), 0.0);
  return std::min(on_course, std::sqrt(kCreep * kCreep + 2.0 * kBraking * left));
}

SegwayCommand SteeringModel::steer(const SegwayState& state, double dt) {
  const auto next = way_.nextStop(passed_);
  const double stop = next ? next->at : kNever;
  if (waiting_ > 0.0) {
    waiting_ -= dt;
  } else {
    comeAlong(state, stop);
    const Eigen::Vector2d to_stop = way_.at(stop) - state.position;
    // The path may pass the position of a stop before the stop is due.
    const bool near = along_ > stop - kWindow;
    if (near && (to_stop.norm() < kArrived || to_stop.dot(way_.direction(stop - 1e-6)) < 0.0)) {
      along_ = passed_ = stop;
      waiting_ = next->pause;
    }
  }

  const auto following = way_.nextStop(passed_);
  const double goal = following ? following->at : kNever;
  const double ahead = along_ + 0.5 + 0.4 * std::max(state.speed, 0.0);
  const Eigen::Vector2d to = wantedPlace(ahead, goal) - state.position;
  const double off_course = wrapped(std::atan2(to.y(), to.x()) - state.yaw);

  const double speed = wantedSpeed(state, off_course, goal);
  SegwayCommand command;
  command.speed = std::clamp(speed, last_.speed - kHaste * dt, last_.speed + kHaste * dt);
  command.turn = waiting_ > 0.0 ? 0.0 : std::clamp(kSteering * off_course, -kTopTurn, kTopTurn);
  last_ = command;
  return command;
}

}  // namespace urban_nav_sim
