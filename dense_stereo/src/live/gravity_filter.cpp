// SPDX-License-Identifier: BSD-3-Clause
#include "live/gravity_filter.hpp"

#include <cmath>
#include <cstdlib>

namespace dense_stereo {

using urban_nav_core::StampNs;

namespace {

constexpr StampNs kSecond = 1'000'000'000;
constexpr double kLeastGravity = 9.3, kMostGravity = 10.3;  // m/s2

}  // namespace

void GravityFilter::add(const urban_nav_core::SpecificForce& sample) {
  if (!sample.force.allFinite()) return;
  if (!last_ || sample.stamp < *last_ || sample.stamp - *last_ > kSecond) {
    first_ = sample.stamp;
    force_ = sample.force;
  } else {
    const double dt = 1e-9 * static_cast<double>(sample.stamp - *last_);
    force_ += (1.0 - std::exp(-dt)) * (sample.force - force_);  // time constant 1 s
  }
  last_ = sample.stamp;
}

std::optional<Eigen::Vector3d> GravityFilter::up(StampNs stamp) const {
  if (!last_ || std::llabs(stamp - *last_) > kSecond || *last_ - *first_ < kSecond) return std::nullopt;
  const double size = force_.norm();
  if (!(size > kLeastGravity && size < kMostGravity)) return std::nullopt;
  return Eigen::Vector3d(force_ / size);
}

}  // namespace dense_stereo
