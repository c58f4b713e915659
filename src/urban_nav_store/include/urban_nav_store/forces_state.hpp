// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "urban_nav_core/types/specific_force.hpp"

namespace urban_nav_store {

/// Stage name under which a store keeps the specific forces of a session, for resumed runs.
constexpr const char* kForcesStage = "gravity";

/// Returns the specific forces at a session's poses as the bytes of a stored state.
std::string packForces(std::vector<urban_nav_core::SpecificForce> forces);
/// Inverse of packForces(), also for all earlier versions. Returns nullopt for damaged bytes and newer versions.
std::optional<std::vector<urban_nav_core::SpecificForce>> unpackForces(std::string_view bytes);

}  // namespace urban_nav_store
