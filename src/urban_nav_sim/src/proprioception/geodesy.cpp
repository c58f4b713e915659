// SPDX-License-Identifier: BSD-3-Clause
#include "proprioception/geodesy.hpp"

#include <cmath>

namespace urban_nav_sim {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kMajor = 6378137.0, kFlattening = 1.0 / 298.257223563;  // WGS 84
constexpr double kSquaredEccentricity = kFlattening * (2.0 - kFlattening);
constexpr double kRadian = M_PI / 180.0;

// Returns the distance from the ellipsoid to the axis along the normal at a latitude, m.
double normalRadius(double sine) { return kMajor / std::sqrt(1.0 - kSquaredEccentricity * sine * sine); }

Vector3d toEarth(const Geodetic& place) {
  const double latitude = place.latitude * kRadian, longitude = place.longitude * kRadian;
  const double n = normalRadius(std::sin(latitude));
  const double out = (n + place.altitude) * std::cos(latitude);
  return {out * std::cos(longitude), out * std::sin(longitude),
          (n * (1.0 - kSquaredEccentricity) + place.altitude) * std::sin(latitude)};
}

// Latitude by fixed-point iteration, which gains 2.5 digits per iteration near the ground.
Geodetic fromEarth(const Vector3d& p) {
  const double out = p.head<2>().norm();
  double latitude = std::atan2(p.z(), out * (1.0 - kSquaredEccentricity)), altitude = 0.0;
  for (int i = 0; i < 8; ++i) {
    const double n = normalRadius(std::sin(latitude));
    altitude = out * std::cos(latitude) + p.z() * std::sin(latitude) -
               n * (1.0 - kSquaredEccentricity * std::sin(latitude) * std::sin(latitude));
    latitude = std::atan2(p.z(), out * (1.0 - kSquaredEccentricity * n / (n + altitude)));
  }
  return {latitude / kRadian, std::atan2(p.y(), p.x()) / kRadian, altitude};
}

// Columns: east, north, up.
Matrix3d axesAt(const Geodetic& place) {
  const double latitude = place.latitude * kRadian, longitude = place.longitude * kRadian;
  const double sp = std::sin(latitude), cp = std::cos(latitude), sl = std::sin(longitude), cl = std::cos(longitude);
  Matrix3d axes;
  axes << -sl, -sp * cl, cp * cl,  //
      cl, -sp * sl, cp * sl,       //
      0.0, cp, sp;
  return axes;
}

}  // namespace

Geodetic fromLocal(const Geodetic& origin, const Vector3d& east_north_up) {
  return fromEarth(toEarth(origin) + axesAt(origin) * east_north_up);
}

Vector3d toLocal(const Geodetic& origin, const Geodetic& place) {
  return axesAt(origin).transpose() * (toEarth(place) - toEarth(origin));
}

}  // namespace urban_nav_sim
