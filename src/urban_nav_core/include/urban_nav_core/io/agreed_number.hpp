// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace urban_nav_core {

/// Returns one number to all callers, threads or processes, that name the same file: the first caller's proposal. The
/// file is not removed, so each agreement needs a new name; missing folders are created. Throws UserError if the file
/// cannot be created or has other content. Thread-safe.
std::int64_t agreeOnNumber(const std::string& path, std::int64_t proposal);

/// Returns the number that another process has written to that file with agreeOnNumber(); nullopt if there is no file.
/// Throws UserError if it has other content. Thread-safe.
std::optional<std::int64_t> findAgreedNumber(const std::string& path);

}  // namespace urban_nav_core
