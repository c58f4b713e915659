// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace urban_nav_sim {

/// A place on or above the ellipsoid WGS 84.
struct Geodetic {
  double latitude = 0.0, longitude = 0.0;  ///< deg
  double altitude = 0.0;                   ///< m above the ellipsoid
};

/// A corner of New College, Oxford; the geoid lies 47 m above the ellipsoid there.
inline constexpr Geodetic kOxford{51.7541, -1.2513, 110.0};

/// The place of a point given in the east, north, up axes (m) of the tangent plane at `origin`, and back.
Geodetic fromLocal(const Geodetic& origin, const Eigen::Vector3d& east_north_up);
Eigen::Vector3d toLocal(const Geodetic& origin, const Geodetic& place);

}  // namespace urban_nav_sim
