// SPDX-License-Identifier: BSD-3-Clause
#include "motion/simulate_drive.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "motion/ground_contact.hpp"
#include "motion/route_path.hpp"
#include "motion/segway.hpp"
#include "motion/spline_motion.hpp"
#include "motion/steering.hpp"
#include "noise/smooth.hpp"

namespace urban_nav_sim {
namespace {

constexpr double kKnot = 0.02;     // s between control points of the spline
constexpr int kDynamicsSteps = 4;  // steps of the dynamics between two control points
constexpr double kMargin = 0.25;   // s before and after the session for which the motion is defined

// Disturbances by the ground and the weight of the driver: at strength 1 and in motion the body sways by 0.3 deg.
class Pushes {
 public:
  Pushes(double strength, const Noise& noise)
      : strength_(strength), pitch_(noise.of("pitch")), turn_(noise.of("turn")) {}

  SegwayDisturbance at(double t, double speed, double slope) const {
    const double strength = strength_ * (0.3 + 0.7 * std::min(std::abs(speed), 1.0));
    SegwayDisturbance pushes;
    pushes.slope = slope;
    pushes.pitch_push = 0.105 * strength * sway(pitch_, t);
    pushes.turn_push = 0.2 * strength * sway(turn_, t);
    return pushes;
  }

 private:
  // Reversed 0.45 s later: a lasting push would displace the robot.
  static double sway(const Noise& noise, double t) {
    return std::clamp(smoothNoise(noise, t / 0.09) - smoothNoise(noise, t / 0.09 - 5.0), -3.0, 3.0);
  }

  double strength_;
  Noise pitch_, turn_;
};

Vector6 toCoordinates(const SegwayState& state, const RoughGround& ground) {
  const AxleOnGround axle = layOnGround(ground, state.position, state.yaw, state.pitch);
  Vector6 all;
  all << state.position, axle.height, state.yaw, state.pitch, axle.roll;
  return all;
}

}  // namespace

std::unique_ptr<Motion> simulateDrive(const World& world, const Route& route, const DriveOptions& options) {
  const Noise noise(options.seed, "ride");
  const RoutePath way(route, options.start + kTopSpeed * (options.duration + kMargin) + 20.0);
  const RoughGround ground(world.ground, options.roughness, noise.of("ground"));
  const Pushes pushes(options.oscillation, noise.of("pushes"));
  SteeringModel driver(way, options.start, options.wander, noise.of("hand"));

  const Eigen::Vector2d place = way.at(options.start), forward = way.direction(options.start);
  const double yaw = std::atan2(forward.y(), forward.x());
  SegwayState state = standingSegway(place, yaw, ground.slope(place.x(), place.y(), yaw));

  // A spline of degree five begins two steps after its first control point.
  const auto before = static_cast<int>(std::ceil(kMargin / kKnot)) + 3;
  const auto after = static_cast<int>(std::ceil((options.duration + kMargin) / kKnot)) + 3;
  std::vector<Vector6> control;
  control.reserve(static_cast<std::size_t>(before + after + 1));
  for (int i = -before; i <= after; ++i) {
    control.push_back(toCoordinates(state, ground));
    const SegwayCommand command = i < 0 ? SegwayCommand{} : driver.steer(state, kKnot);
    const double slope = ground.slope(state.position.x(), state.position.y(), state.yaw);
    for (int j = 0; j < kDynamicsSteps; ++j) {
      const double t = kKnot * (i + static_cast<double>(j) / kDynamicsSteps);
      state = stepSegway(state, command, pushes.at(t + 1.0, state.speed, slope), kKnot / kDynamicsSteps);
    }
  }
  return std::make_unique<SplineMotion>(TimeSpline(-before * kKnot, kKnot, std::move(control)), options.duration);
}

}  // namespace urban_nav_sim
