// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

namespace urban_nav_core {

/// Returns the matrix from measured vectors to the axes of the device. `text`: for x, y and z of the device, the
/// measured axis with its sign, for example "-x,-y,-z" or "y,z,x". nullopt for any other text.
std::optional<Eigen::Matrix3d> parseAxisMap(const std::string& text);
/// Returns the text that parseAxisMap() reads. Requires a matrix with one entry of 1 or -1 in each row and column.
std::string printAxisMap(const Eigen::Matrix3d& map);
/// Returns all 48 axis maps: signed permutations, rotations and reflections.
std::vector<Eigen::Matrix3d> allAxisMaps();

}  // namespace urban_nav_core
