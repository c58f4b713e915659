// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace urban_nav_store {

/// Kind of a file according to its first bytes, read without SQLite, which might modify the file.
enum class FileKind {
  Absent,  ///< no file, or an empty one
  Store,
  NewerStore,
  Release,      ///< frozen store (release.hpp)
  OtherSqlite,  ///< database of another program
  Other,
};
FileKind fileKind(const std::string& path);

/// Returns the path with symbolic links resolved: SQLite derives the names of auxiliary files from that.
std::string resolved(const std::string& path);

enum class Releases { Refused, Allowed };
/// Throws UserError unless `path` is a store readable by this version or does not exist. `releases`: whether a release
/// is accepted.
void refuseOtherFiles(const std::string& path, Releases releases = Releases::Refused);

}  // namespace urban_nav_store
