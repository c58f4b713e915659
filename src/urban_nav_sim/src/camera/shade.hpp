// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "camera/sky.hpp"
#include "ray_tracing/tracer.hpp"

namespace urban_nav_sim {

/// Does light of the sun fall on the seen side of this point, if nothing is in between? Leaves let it through.
bool facesSun(const SurfacePoint& point, const Sky& sky);

/// The light that a point sends to the viewer: linear RGB, 1 = a white sheet in the sun. `direction`: of the viewing
/// ray, unit; `sunlit`: the share of the sun that nothing hides from the point.
Eigen::Vector3f shade(const SurfacePoint& point, const Appearance& look, const Eigen::Vector3f& direction, float sunlit,
                      const Sky& sky);

/// What is left of it after so many metres of air.
Eigen::Vector3f throughAir(const Eigen::Vector3f& radiance, float metres, const Sky& sky);

}  // namespace urban_nav_sim
