// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pose_graph/level.hpp"

namespace pose_graph {

/// The stage by whose name a store keeps the forces of a session, for runs that go on from it.
constexpr const char* kForcesStage = "gravity";

/// What was felt at a session's poses, as bytes of a store.
std::string packForces(const std::vector<FeltForce>& forces);
/// Empty where they are not whole, or of another version.
std::optional<std::vector<FeltForce>> unpackForces(std::string_view bytes);

}  // namespace pose_graph
