// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace urban_nav_sim {

/// A geodetic position relative to the ellipsoid WGS 84.
struct Geodetic {
  double latitude = 0.0, longitude = 0.0;  ///< deg
  double altitude = 0.0;                   ///< m above the ellipsoid
};

/// A corner of New College, Oxford, where the geoid lies 47 m above the ellipsoid.
inline constexpr Geodetic kOxford{51.7541, -1.2513, 110.0};

/// Converts between geodetic positions and east, north, up coordinates (m) of the tangent plane at `origin`.
Geodetic fromLocal(const Geodetic& origin, const Eigen::Vector3d& east_north_up);
Eigen::Vector3d toLocal(const Geodetic& origin, const Geodetic& place);

}  // namespace urban_nav_sim
