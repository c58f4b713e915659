// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "join/join_run.hpp"
#include "join/release_run.hpp"

namespace urban_nav {

/// Result for a session to be added to a release.
struct AddedSession {
  urban_nav_store::SessionId session;
  bool joined = false;                    ///< by closures with the release
  bool kept = false;                      ///< it has places that are new to the release
  std::size_t places = 0, keyframes = 0;  ///< added by it
  std::string reason;                     ///< if it is not kept
};

struct ReleaseAddition {
  ReleaseRun release;
  std::vector<AddedSession> added;  ///< in the order of their start
};

/// Adds the sessions of `options.stores` to a release and writes the next release to `options.out`. Places of the
/// release are in the map of all sessions, its poses stay fixed, and its source stores are not needed; covariances of
/// added sessions are relative to it. Throws the errors of Join, and UserError if `release` is not a release.
ReleaseAddition addToRelease(const std::string& release, JoinOptions options, AllStages stages, Console& console);

}  // namespace urban_nav
