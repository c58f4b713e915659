// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace urban_nav_core {

/// Returns the number on which all callers agree that name the same file, threads or processes: the proposal of the
/// first. The file stays, so its name must be new for each agreement; missing folders are made. Throws UserError if it
/// cannot be made or holds something else. Thread-safe.
std::int64_t agreeOnNumber(const std::string& path, std::int64_t proposal);

/// Returns the number that another process has written to that file, as agreeOnNumber() does, and nothing while there
/// is no file. Throws UserError if it holds something else. Thread-safe.
std::optional<std::int64_t> findAgreedNumber(const std::string& path);

}  // namespace urban_nav_core
