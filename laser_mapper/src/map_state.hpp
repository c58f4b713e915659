// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "laser_mapper/parameters.hpp"
#include "urban_nav_core/types/pose_with_covariance.hpp"

namespace laser_mapper {

/// Inputs of a session's map besides its chunks and poses.
struct MapState {
  Parameters parameters;
  std::vector<urban_nav_core::Matrix6d> covariances;  ///< RelativeCovariances::values()
};

/// Key of the state in StageStates.
constexpr const char* kMapState = "laser_mapper.map";

std::string packMapState(MapState state);
/// Parses the state. Throws DataError if the bytes are damaged or of another version.
MapState unpackMapState(std::string_view bytes);

}  // namespace laser_mapper
