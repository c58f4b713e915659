// SPDX-License-Identifier: BSD-3-Clause
#include "proprioception/gps.hpp"

#include <algorithm>
#include <cmath>

#include "noise/smooth.hpp"

namespace urban_nav_sim {
namespace {

using Eigen::Vector3d;

constexpr double kPatch = 20.0;          // m over which the visible sky changes
constexpr double kNoFix = 0.8;           // share of the sky hidden
constexpr double kSlowTime = 180.0;      // s
constexpr double kMultipathTime = 20.0;  // s
const Vector3d kAxes(1.0, 1.0, 2.0);     // satellites are only above: vertical errors are twice as large

}  // namespace

GpsOptions perfectGps() {
  GpsOptions options;
  options.slow_sigma = options.white_sigma = options.multipath_sigma = options.velocity_sigma = 0.0;
  options.gaps = false;
  return options;
}

Gps::Gps(const Motion& motion, const urban_nav_core::Pose& T_base_gps, const GpsOptions& options, const Clock& clock,
         const Noise& noise)
    : motion_(motion),
      T_base_gps_(T_base_gps),
      options_(options),
      clock_(clock),
      white_(noise.of("white")),
      sky_(noise.of("sky")),
      multipath_(noise.of("multipath")),
      slow_(RandomWalk::drawnBack(options.slow_sigma, kSlowTime, motion.duration(), noise.of("slow"))) {}

// Returns the hidden share of the sky, 0 ... 1.
double Gps::hiddenSky(double t) const {
  const Vector3d place = motion_.at(t).T_world_base.t() / kPatch;
  return std::clamp(0.5 + 0.3 * smoothNoise(sky_, place.x(), place.y()), 0.0, 1.0);
}

bool Gps::hasFix(double t) const { return !options_.gaps || hiddenSky(t) < kNoFix; }

GpsMeasurement Gps::fix(std::int64_t k) const {
  const double t = schedule_.at(k);
  const auto counter = static_cast<std::uint64_t>(k);
  const MotionState motion_state = motion_.at(t);
  const double reflected = 2.0 * hiddenSky(t) * options_.multipath_sigma;
  Vector3d multipath;
  for (std::uint64_t i = 0; i < 3; ++i) {
    multipath[static_cast<Eigen::Index>(i)] = reflected * smoothNoise(multipath_.of(i), t / kMultipathTime);
  }
  const Vector3d off =
      kAxes.cwiseProduct(slow_.at(t) + options_.white_sigma * white_.of("place").normal3(counter) + multipath);
  const Geodetic place = fromLocal(options_.origin, motion_state.T_world_base * T_base_gps_.t() + off);

  GpsMeasurement measured;
  measured.latitude = place.latitude;
  measured.longitude = place.longitude;
  measured.altitude = place.altitude;
  // Receivers know the geometry of their satellites but not the walls: their stated error contains half of the
  // multipath.
  measured.sigma = std::max(std::hypot(options_.slow_sigma, options_.white_sigma, 0.5 * reflected), 0.01) * kAxes;
  measured.velocity = motion_state.velocity_world +
                      motion_state.T_world_base.q() * motion_state.rate_base.cross(T_base_gps_.t()) +
                      options_.velocity_sigma * kAxes.cwiseProduct(white_.of("velocity").normal3(counter));
  return measured;
}

GpsMeasurement Gps::at(std::int64_t k) const {
  const double t = schedule_.at(k);
  GpsMeasurement measured;
  if (hasFix(t)) {
    measured = fix(k);
  } else {
    std::int64_t last = k;
    while (last >= 0 && !hasFix(schedule_.at(last))) --last;
    if (last >= 0) measured = fix(last);
    if (last < 0) {
      measured.latitude = options_.origin.latitude;
      measured.longitude = options_.origin.longitude;
      measured.altitude = options_.origin.altitude;
    }
    measured.has_fix = false;
    measured.velocity.setZero();
    measured.sigma.setConstant(1e3);
  }
  measured.stamp = clock_.stamp(k, t);
  return measured;
}

}  // namespace urban_nav_sim
