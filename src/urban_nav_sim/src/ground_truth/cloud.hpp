// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>

#include "motion/motion.hpp"
#include "world/world.hpp"

namespace urban_nav_sim {

/// Places of a triangle, at most `spacing` (m) from the next along its longest side and across it, corners and sides
/// included; `weights`: of the three corners, which sum to one.
void sampleTriangle(const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& c, float spacing,
                    const std::function<void(const Eigen::Vector3f& weights)>& place);

/// cloud.ply of the truth (docs/files.md): everything that stands still within 30 m of the way, at most 0.05 m apart,
/// x, y, z (float, m, `world`) and class (uchar, SurfaceClass), binary. Nothing that lies over 0.3 m below the ground.
/// Leaves where there are leaves. In the order of the world's parts; memory does not grow with the number of points.
/// Throws UserError naming the file if it cannot be written.
void writeCloud(const std::string& path, const World& world, const Motion& motion);

}  // namespace urban_nav_sim
