// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/command.hpp"
#include "base/json.hpp"
#include "join/release_run.hpp"

namespace urban_nav {

/// Returns the command that writes a release of a map, or compares two releases.
Command releaseCommand();

/// Returns the summary of a release, without its warnings.
Json toJson(const ReleaseRun& run);

}  // namespace urban_nav
