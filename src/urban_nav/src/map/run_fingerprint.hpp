// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "map/map_options.hpp"
#include "map/stage_list.hpp"
#include "urban_nav_input/session/sessions.hpp"
#include "urban_nav_store/session.hpp"

namespace urban_nav {

/// All dependencies of the stored result of a session, so that an interrupted run resumes only if the result would be
/// the same: pairs of a name for the user ("inputs", "options", "parameters", "program", "stages", "store")
/// and a digest. Inputs are identified by names, sizes, times of the last change, and the first and last bytes of some
/// files, without ground truth; the program by its executable and libraries.
using RunFingerprint = std::vector<std::pair<std::string, std::string>>;
RunFingerprint fingerprint(const MapOptions& options, const StageList& stages,
                           const urban_nav_input::InputSession& session);

/// Returns the identity of a session: the content of its folder or first bag, independent of path and time of copying.
/// Further bags extend the same session.
urban_nav_store::SessionOrigin origin(const MapOptions& options, const urban_nav_input::InputSession& session);

/// Returns the fingerprint of each bag of the session; empty for a folder.
std::vector<std::string> bagFingerprints(const MapOptions& options, const urban_nav_input::InputSession& session);

/// Returns the names of the digests that differ: "parameters, program". `but`: names that are ignored.
std::string differences(const RunFingerprint& a, const RunFingerprint& b, const std::vector<std::string>& but = {});

}  // namespace urban_nav
