// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "join/join_run.hpp"
#include "join/release_run.hpp"

namespace urban_nav {

/// Result for a session that was offered to a release.
struct AddedSession {
  urban_nav_store::SessionId session;
  bool joined = false;                    ///< closures tie it to the release
  bool kept = false;                      ///< it shows what the release had not
  std::size_t places = 0, keyframes = 0;  ///< that it added
  std::string reason;                     ///< if it is not kept
};

struct ReleaseAddition {
  ReleaseRun release;
  std::vector<AddedSession> added;  ///< in the order of their start
};

/// Adds the sessions of `options.stores` to a release and writes the next one to `options.out`. Places of the release
/// are known to all of them, its poses stay as they are, and the stores that it was made from are not needed;
/// covariances of added sessions are relative to it. Throws as Join does, and UserError if `release` is no release.
ReleaseAddition addToRelease(const std::string& release, JoinOptions options, AllStages stages, Console& console);

}  // namespace urban_nav
