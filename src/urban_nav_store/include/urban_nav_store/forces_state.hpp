// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "urban_nav_core/types/specific_force.hpp"

namespace urban_nav_store {

/// The stage by whose name a store keeps the forces of a session, for runs that go on from it.
constexpr const char* kForcesStage = "gravity";

/// Returns the specific forces at a session's poses as the bytes of a stored state.
std::string packForces(std::vector<urban_nav_core::SpecificForce> forces);
/// Inverse of packForces, for the bytes of every earlier version too. Returns nullopt for damaged bytes and for those
/// of a newer version.
std::optional<std::vector<urban_nav_core::SpecificForce>> unpackForces(std::string_view bytes);

}  // namespace urban_nav_store
