// SPDX-License-Identifier: BSD-3-Clause
#include "proprioception/imu.hpp"

#include <cmath>
#include <utility>

#include "noise/smooth.hpp"

namespace urban_nav_sim {

using Eigen::Vector3d;

ImuOptions perfectImu() {
  ImuOptions options;
  options.rate_density = options.rate_bias = options.rate_walk = 0.0;
  options.force_density = options.force_bias = 0.0;
  options.rate_offset = options.force_offset = options.scale_sigma = options.axes_sigma = 0.0;
  options.field_sigma = options.field_bias = options.field_disturbance = 0.0;
  return options;
}

namespace {

/// Returns three numbers, each uniform within +-`largest`.
Vector3d evenWithin(double largest, const Noise& noise) {
  return {noise.uniform(0, -largest, largest), noise.uniform(1, -largest, largest),
          noise.uniform(2, -largest, largest)};
}

Eigen::Matrix3d drawMatrix(const ImuOptions& options, const Noise& noise) {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      matrix(row, column) += (row == column ? options.scale_sigma : options.axes_sigma) *
                             noise.normal(static_cast<std::uint64_t>(3 * row + column));
  }
  return matrix;
}

void exchange(Vector3d& vector) { std::swap(vector.x(), vector.y()); }
void turnOver(Vector3d& vector) { vector.tail<2>() = -vector.tail<2>(); }

}  // namespace

Vector3d earthField() {
  constexpr double kField = 48.6e-6, kDip = 66.5 * M_PI / 180.0, kWest = 2.5 * M_PI / 180.0;
  const double level = kField * std::cos(kDip);
  return {-level * std::sin(kWest), level * std::cos(kWest), -kField * std::sin(kDip)};
}

Imu::Imu(const Motion& motion, const urban_nav_core::Pose& T_base_imu, const ImuOptions& options, const Clock& clock,
         const Noise& noise)
    : motion_(motion),
      T_base_imu_(T_base_imu),
      options_(options),
      clock_(clock),
      rate_noise_(noise.of("rate")),
      force_noise_(noise.of("force")),
      field_noise_(noise.of("field")),
      rate_bias_(RandomWalk::free(options.rate_bias, options.rate_walk, motion.duration(), noise.of("rate bias"))),
      force_bias_(RandomWalk::drawnBack(options.force_bias, options.force_bias_time, motion.duration(),
                                        noise.of("force bias"))),
      field_bias_(options.field_bias * noise.of("field bias").normal3(0)),
      rate_offset_(evenWithin(options.rate_offset, noise.of("rate offset"))),
      force_offset_(evenWithin(options.force_offset, noise.of("force offset"))),
      rate_matrix_(drawMatrix(options, noise.of("rate matrix"))),
      force_matrix_(drawMatrix(options, noise.of("force matrix"))) {}

ImuMeasurement Imu::truth(double t) const {
  const MotionState motion_state = motion_.at(t);
  const Eigen::Quaterniond& R_world_base = motion_state.T_world_base.q();
  const Eigen::Quaterniond R_imu_base = T_base_imu_.q().conjugate();
  const Vector3d& arm = T_base_imu_.t();
  const Vector3d& w = motion_state.rate_base;
  const Vector3d against_gravity(0.0, 0.0, kGravity);

  ImuMeasurement measured;
  measured.rate = R_imu_base * w;
  measured.specific_force =
      R_imu_base * (R_world_base.conjugate() * (motion_state.acceleration_world + against_gravity) +
                    motion_state.rate_change_base.cross(arm) + w.cross(w.cross(arm)));
  measured.field = R_imu_base * (R_world_base.conjugate() * earthField());
  return measured;
}

ImuMeasurement Imu::at(std::int64_t k) const {
  const double t = schedule_.at(k);
  const auto counter = static_cast<std::uint64_t>(k);
  ImuMeasurement measured = truth(t);
  // White noise averaged over a period has the standard deviation density times the root of the rate.
  const double per_sample = 1.0 / std::sqrt(schedule_.period);
  measured.stamp = clock_.stamp(k, t);
  measured.rate = rate_matrix_ * measured.rate;
  measured.specific_force = force_matrix_ * measured.specific_force;
  measured.rate += rateBias(t) + options_.rate_density * per_sample * rate_noise_.normal3(counter);
  measured.specific_force += forceBias(t) + options_.force_density * per_sample * force_noise_.normal3(counter);
  measured.field += field_bias_ + options_.field_sigma * field_noise_.normal3(counter);
  if (options_.field_disturbance > 0.0) {
    const urban_nav_core::Pose T_world_base = motion_.at(t).T_world_base;
    const Vector3d place = T_world_base.t() / 5.0;
    Vector3d disturbance;
    for (std::uint64_t i = 0; i < 3; ++i) {
      disturbance[static_cast<Eigen::Index>(i)] = smoothNoise(field_noise_.of("place").of(i), place.x(), place.y());
    }
    measured.field +=
        options_.field_disturbance * (T_world_base.q() * T_base_imu_.q()).conjugate()._transformVector(disturbance);
  }
  applyMistakes(t, measured);
  return measured;
}

void Imu::applyMistakes(double t, ImuMeasurement& measured) const {
  const ImuMistakes& mistakes = options_.mistakes;
  if (mistakes.removes_gravity) {
    const Eigen::Quaterniond R_world_imu = motion_.at(t).T_world_base.q() * T_base_imu_.q();
    measured.specific_force -= R_world_imu.conjugate() * Vector3d(0.0, 0.0, kGravity);
  }
  for (Vector3d* vector : {&measured.rate, &measured.specific_force, &measured.field}) {
    if (mistakes.is_ned) turnOver(*vector);
    if (mistakes.exchanges_axes) exchange(*vector);
  }
  if (mistakes.uses_degrees) measured.rate *= 180.0 / M_PI;
}

}  // namespace urban_nav_sim
