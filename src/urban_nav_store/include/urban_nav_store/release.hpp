// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_store/session.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav_store {

/// Identity of a release, as it states it.
struct ReleaseHead {
  std::int64_t version = 1;          ///< that of its parent, plus one
  std::string digest;                ///< of all its rows but this one
  std::vector<std::string> parents;  ///< digests of the releases that it was made from, the last one first
};

/// Returns whether a file exists at `path` and begins as a release of this or an earlier version does.
bool isRelease(const std::string& path);

/// Returns what a release states about itself. Throws DataError if it states nothing.
ReleaseHead readReleaseHead(Store& release);

/// Makes a release of the store `store`, which is closed and changes: its rows, with `head`, whose digest is computed,
/// in a single file that is never written to again and appears under `path` whole. The same rows give the same bytes.
/// `first`: session of the store, with which the head is stored. Returns the head.
ReleaseHead freeze(const std::string& store, const SessionId& first, ReleaseHead head, const std::string& path);

}  // namespace urban_nav_store
