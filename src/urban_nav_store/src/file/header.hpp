// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace urban_nav_store {

/// What the first bytes of a file say, read without SQLite, which might change what it opens.
enum class FileKind {
  Absent,  ///< nothing there, or an empty file
  Store,
  NewerStore,
  Release,      ///< a store that is frozen (release.hpp)
  OtherSqlite,  ///< a database of another program
  Other,
};
FileKind fileKind(const std::string& path);

/// The path itself, or what it points to: SQLite names the files beside a store after that.
std::string resolved(const std::string& path);

enum class Releases { Refused, Allowed };
/// UserError where `path` is neither a store that this version can read nor absent; a release is one where they are
/// allowed.
void refuseOtherFiles(const std::string& path, Releases releases = Releases::Refused);

}  // namespace urban_nav_store
