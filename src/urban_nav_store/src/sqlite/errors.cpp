// SPDX-License-Identifier: BSD-3-Clause
#include "sqlite/errors.hpp"

#include <sqlite3.h>

#include <cerrno>
#include <cstring>
#include <new>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav_store {

using urban_nav_core::DataError;
using urban_nav_core::UserError;

namespace {

constexpr const char* kWhenDamaged = "an intact copy (`sqlite3 FILE .recover` saves the readable part)";

bool noRoom(int system_error) { return system_error == ENOSPC || system_error == EDQUOT || system_error == EFBIG; }

}  // namespace

void throwDamaged(const std::string& file, const std::string& what) {
  throw DataError(file, "is damaged: " + what, kWhenDamaged);
}

void throwClosed(const std::string& file) { throw UserError(file, "is closed", ""); }

void throwReadOnly(const std::string& file) { throw UserError(file, "was opened for reading only", ""); }

void throwError(const std::string& file, int code, int system_error, const std::string& message) {
  const std::string because = system_error != 0 ? std::string(": ") + std::strerror(system_error) : "";
  const int primary = code & 0xff;
  if (primary == SQLITE_FULL || (primary == SQLITE_IOERR && noRoom(system_error)))
    throw DataError(file, "cannot grow: the disk is full; what was committed before is safe",
                    "free disk space, then repeat the call");
  switch (primary) {
    case SQLITE_CORRUPT: throwDamaged(file, sqlite3_errstr(code));
    case SQLITE_NOTADB: throwDamaged(file, "its header is not that of a store");
    case SQLITE_NOMEM: throw std::bad_alloc();
    case SQLITE_READONLY:
    case SQLITE_PERM:
    case SQLITE_AUTH: throw UserError(file, "cannot be written" + because, "a file and a folder that can be written");
    case SQLITE_CANTOPEN: throw UserError(file, "cannot be opened" + because, "a file and a folder that can be used");
    case SQLITE_BUSY:
    case SQLITE_LOCKED: throw UserError(file, "is in use by another program", "one writer at a time");
    case SQLITE_TOOBIG: throw UserError(file, "a value is too large for one row", "at most 1 GB");
    case SQLITE_IOERR: throw DataError(file, "cannot be read or written" + because, "a working disk");
    default: throw DataError(file, "SQLite error: " + message, "");
  }
}

}  // namespace urban_nav_store
