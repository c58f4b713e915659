// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_store/session.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav_store {

/// Identity of a release, as stored in it.
struct ReleaseHead {
  std::int64_t version = 1;          ///< version of its parent plus one
  std::string digest;                ///< of all rows except this one
  std::vector<std::string> parents;  ///< digests of the releases from which it was made, the last one first
};

/// Returns whether a file exists at `path` and begins like a release of this or an earlier version.
bool isRelease(const std::string& path);

/// Returns the head stored in a release. Throws DataError without one.
ReleaseHead readReleaseHead(Store& release);

/// Makes a release from the store `store`, which is modified and closed: its rows and `head`, whose digest is computed,
/// in a single immutable file that is written to `path` completely or not at all. Equal rows give identical bytes.
/// `first`: session of the store under which the head is stored. Returns the head.
ReleaseHead freeze(const std::string& store, const SessionId& first, ReleaseHead head, const std::string& path);

}  // namespace urban_nav_store
