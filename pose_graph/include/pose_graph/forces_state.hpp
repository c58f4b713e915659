// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pose_graph/level.hpp"

namespace urban_nav_core {
class Archive;
}

namespace pose_graph {

/// The stage by whose name a store keeps the forces of a session, for runs that go on from it.
constexpr const char* kForcesStage = "gravity";

/// Reads or writes one force of a state (urban_nav_core/io/archive.hpp).
void archive(urban_nav_core::Archive& archive, FeltForce& value);

/// Returns the specific forces at a session's poses as the bytes of a stored state.
std::string packForces(std::vector<FeltForce> forces);
/// Inverse of packForces, for the bytes of every earlier version too. Returns nullopt for damaged bytes and for those of a newer version.
std::optional<std::vector<FeltForce>> unpackForces(std::string_view bytes);

}  // namespace pose_graph
