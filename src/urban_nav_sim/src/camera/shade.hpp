// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "camera/sky.hpp"
#include "ray_tracing/tracer.hpp"

namespace urban_nav_sim {

/// Returns whether the visible side of a point faces the sun. Leaves transmit light.
bool facesSun(const SurfacePoint& point, const Sky& sky);

/// Returns the light of a point towards the viewer: linear RGB, 1 = a white sheet in the sun. `direction`: of the
/// viewing ray, unit; `sunlit`: unoccluded share of the sun;
/// `lamps`: radiance of a white surface there by lamps alone.
Eigen::Vector3f shade(const SurfacePoint& point, const Appearance& look, const Eigen::Vector3f& direction, float sunlit,
                      const Eigen::Vector3f& lamps, const Sky& sky);

/// Returns the radiance after `metres` of air.
Eigen::Vector3f throughAir(const Eigen::Vector3f& radiance, float metres, const Sky& sky);

}  // namespace urban_nav_sim
