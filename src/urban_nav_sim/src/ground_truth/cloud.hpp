// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>

#include "motion/motion.hpp"
#include "world/world.hpp"

namespace urban_nav_sim {

/// Samples a triangle, including corners and sides, with at most `spacing` (m) along its longest side and across it;
/// `weights`: barycentric coordinates.
void sampleTriangle(const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& c, float spacing,
                    const std::function<void(const Eigen::Vector3f& weights)>& place);

/// Writes cloud.ply of the truth (docs/files.md): static surfaces within 30 m of the path, at most 0.05 m apart, x, y,
/// z (float, m, `world`) and class (uchar, SurfaceClass), binary. Without points over 0.3 m below the ground, and only
/// actual leaves of their cards. In the order of the parts of the world; memory is independent of the number of points.
/// Throws UserError naming the file if it cannot be written.
void writeCloud(const std::string& path, const World& world, const Motion& motion);

}  // namespace urban_nav_sim
