// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace urban_nav_store {

/// Throws the error of an SQLite result code (extended or not): UserError for an error of the caller (an unwritable
/// path, a file in use), DataError for an error of the file or the disk. `system_error`: errno of the failed call, 0 if
/// none failed. `message`: SQLite's message, used for other codes.
[[noreturn]] void throwError(const std::string& file, int code, int system_error, const std::string& message);

[[noreturn]] void throwDamaged(const std::string& file, const std::string& what);
[[noreturn]] void throwClosed(const std::string& file);
[[noreturn]] void throwReadOnly(const std::string& file);

}  // namespace urban_nav_store
