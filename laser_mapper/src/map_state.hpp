// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "laser_mapper/parameters.hpp"
#include "urban_nav_core/types/pose_with_covariance.hpp"

namespace laser_mapper {

/// What the map of a session was made with, besides its chunks and poses.
struct MapState {
  Parameters parameters;
  std::vector<urban_nav_core::Matrix6d> covariances;  ///< RelativeCovariances::values()
};

/// Key of the state in StageStates.
constexpr const char* kMapState = "laser_mapper.map";

std::string packMapState(MapState state);
/// Returns the state; throws DataError if the bytes are damaged or of another version.
MapState unpackMapState(std::string_view bytes);

}  // namespace laser_mapper
