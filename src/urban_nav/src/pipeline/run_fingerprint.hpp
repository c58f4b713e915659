// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "input/sessions.hpp"
#include "pipeline/map_pipeline.hpp"
#include "urban_nav_store/session.hpp"

namespace urban_nav {

/// What the result of a session depends on, so that a run that was cut off goes on only where the result would be the same: pairs
/// of a name for people ("parameters", "inputs", "options", "program", "stages", "store") and a digest. Inputs are told by names, sizes, times of the last
/// change, and the beginnings and ends of some files; the truth among them does not count. The program is told by the files it
/// was loaded from, libraries included.
using RunIdentity = std::vector<std::pair<std::string, std::string>>;
RunIdentity identityOf(const MapRequest& request, const Session& session);

/// What tells a session from others: by the content of its folder or its first bag, wherever it lies and whenever it was copied. More bags make
/// the same session longer.
urban_nav_store::SessionOrigin originOf(const MapRequest& request, const Session& session);

/// Of each of the session's bags, as the identity tells inputs. None of a folder.
std::vector<std::string> bagsOf(const MapRequest& request, const Session& session);

/// Names of what differs: "parameters, program". `but`: names that do not count.
std::string differences(const RunIdentity& a, const RunIdentity& b, const std::vector<std::string>& but = {});

}  // namespace urban_nav
