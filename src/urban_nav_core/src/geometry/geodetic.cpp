// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/geometry/geodetic.hpp"

#include <cmath>

#include "urban_nav_core/geometry/se3.hpp"

namespace urban_nav_core {

namespace {

constexpr double kEarthRadius = 6378137.0, kFlattening = 1.0 / 298.257223563;  // WGS 84
constexpr double kEccentricity2 = kFlattening * (2.0 - kFlattening);

double normalRadius(double sine) { return kEarthRadius / std::sqrt(1.0 - kEccentricity2 * sine * sine); }

Vector3d toEarth(const Geodetic& at) {
  const double sine = std::sin(at.latitude), cosine = std::cos(at.latitude), n = normalRadius(sine);
  return {(n + at.height) * cosine * std::cos(at.longitude), (n + at.height) * cosine * std::sin(at.longitude),
          (n * (1.0 - kEccentricity2) + at.height) * sine};
}

}  // namespace

LocalTangent::LocalTangent(const Geodetic& origin) : origin_(toEarth(origin)) {
  const double sp = std::sin(origin.latitude), cp = std::cos(origin.latitude);
  const double sl = std::sin(origin.longitude), cl = std::cos(origin.longitude);
  R_local_earth_ << -sl, cl, 0.0, -sp * cl, -sp * sl, cp, cp * cl, cp * sl, sp;
}

Vector3d LocalTangent::toLocal(const Geodetic& position) const {
  return R_local_earth_ * (toEarth(position) - origin_);
}

Geodetic LocalTangent::toGeodetic(const Vector3d& local) const {
  const Vector3d p = origin_ + R_local_earth_.transpose() * local;
  const double across = std::hypot(p.x(), p.y());
  Geodetic at;
  at.longitude = std::atan2(p.y(), p.x());
  // Bowring (1976): one iteration from the reduced latitude is exact to nanometres near the ground.
  const double minor = kEarthRadius * (1.0 - kFlattening);
  const double reduced = std::atan2(p.z() * kEarthRadius, across * minor);
  const double s = std::sin(reduced), c = std::cos(reduced);
  at.latitude = std::atan2(p.z() + kEccentricity2 / (1.0 - kEccentricity2) * minor * s * s * s,
                           across - kEccentricity2 * kEarthRadius * c * c * c);
  const double sine = std::sin(at.latitude), n = normalRadius(sine);
  at.height = across * std::cos(at.latitude) + p.z() * sine - kEarthRadius * kEarthRadius / n;
  return at;
}

}  // namespace urban_nav_core
