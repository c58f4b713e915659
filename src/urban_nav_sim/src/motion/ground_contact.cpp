// SPDX-License-Identifier: BSD-3-Clause
#include "motion/ground_contact.hpp"

#include <cmath>
#include <utility>

#include "motion/simulate_drive.hpp"
#include "noise/smooth.hpp"

namespace urban_nav_sim {
namespace {

constexpr double kGradientStep = 0.02;                  // m: step of the differences of the gradient
constexpr double kShort = 0.12, kShortHeight = 1.2e-3;  // m: spacing of the lattice and standard deviation
constexpr double kLong = 0.5, kLongHeight = 6e-3;       // m

// Returns the height of the centre of a wheel whose contact point lies r below it along the normal.
double wheelCentre(const RoughGround& ground, const Eigen::Vector2d& centre) {
  Eigen::Vector2d touch = centre;
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  for (int i = 0; i < 3; ++i) {
    normal = ground.normal(touch.x(), touch.y());
    touch = centre - kWheelRadius * normal.head<2>();
  }
  return ground.height(touch.x(), touch.y()) + kWheelRadius * normal.z();
}

}  // namespace

RoughGround::RoughGround(std::function<double(double, double)> smooth, double roughness, const Noise& noise)
    : smooth_(std::move(smooth)), roughness_(roughness), short_(noise.of("short")), long_(noise.of("long")) {
  if (!smooth_) smooth_ = [](double, double) { return 0.0; };
}

double RoughGround::height(double x, double y) const {
  if (roughness_ == 0.0) return smooth_(x, y);
  return smooth_(x, y) + roughness_ * (kShortHeight * smoothNoise(short_, x / kShort, y / kShort) +
                                       kLongHeight * smoothNoise(long_, x / kLong, y / kLong));
}

Eigen::Vector2d RoughGround::gradient(double x, double y) const {
  return Eigen::Vector2d(smooth_(x + kGradientStep, y) - smooth_(x - kGradientStep, y),
                         smooth_(x, y + kGradientStep) - smooth_(x, y - kGradientStep)) /
         (2.0 * kGradientStep);
}

Eigen::Vector3d RoughGround::normal(double x, double y) const {
  const Eigen::Vector2d g = gradient(x, y);
  return Eigen::Vector3d(-g.x(), -g.y(), 1.0).normalized();
}

double RoughGround::slope(double x, double y, double yaw) const {
  return std::atan(gradient(x, y).dot(Eigen::Vector2d(std::cos(yaw), std::sin(yaw))));
}

AxleOnGround layOnGround(const RoughGround& ground, const Eigen::Vector2d& middle, double yaw, double pitch) {
  const Eigen::Vector2d forward(std::cos(yaw), std::sin(yaw)), left(-forward.y(), forward.x());
  AxleOnGround axle;
  for (int i = 0; i < 3; ++i) {
    // The horizontal part of the second column of Rz(yaw) Ry(pitch) Rx(roll).
    const Eigen::Vector2d half =
        0.5 * kTrack * (std::cos(axle.roll) * left + std::sin(pitch) * std::sin(axle.roll) * forward);
    const double on_left = wheelCentre(ground, middle + half), on_right = wheelCentre(ground, middle - half);
    axle.height = 0.5 * (on_left + on_right);
    axle.roll = std::asin((on_left - on_right) / kTrack / std::cos(pitch));
  }
  return axle;
}

}  // namespace urban_nav_sim
