// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_sim/lidar_model.hpp"

#include <cmath>

#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_sim {

LidarModel parseLidarModel(const std::string& word, const std::string& where) {
  if (word == "livox") return {LidarModel::Pattern::Rosette, LidarModel::kRosetteLines};
  if (word == "planar") return {LidarModel::Pattern::Rings, 1};
  const auto number = urban_nav_core::parseNumber(word);
  if (!number || *number != std::floor(*number) || *number < LidarModel::kFewestRings ||
      *number > LidarModel::kMostRings)
    throw urban_nav_core::UserError(where, "\"" + word + "\"",
                                    std::to_string(LidarModel::kFewestRings) + "..." +
                                        std::to_string(LidarModel::kMostRings) + " rings, or livox, or planar");
  return {LidarModel::Pattern::Rings, static_cast<int>(*number)};
}

}  // namespace urban_nav_sim
