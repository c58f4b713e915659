// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace urban_nav_store {

/// zlib at level 3, with the length in front. Measured on a second of New College's left laser, 380 KB: 48 KB in 2.3
/// ms, where level 1 makes 51 KB in 1.6 ms and level 6 45 KB in 5.4 ms.
std::string deflated(std::string_view bytes);
/// Empty where the bytes are no such thing, or would become more than `limit`.
std::optional<std::string> inflated(std::string_view bytes, std::size_t limit);

}  // namespace urban_nav_store
