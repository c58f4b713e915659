// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace urban_nav_store {

/// Appends numbers byte by byte in columns, least significant first. Each number is replaced by its difference to the
/// previous one, modulo 2^(8 bytes), so that smooth columns compress well.
void appendColumn(std::string& bytes, const std::vector<std::uint32_t>& values, int width);

/// Inverse of appendColumn() for `count` numbers, whose bytes are removed. Requires count * width bytes.
std::vector<std::uint32_t> takeColumn(std::string_view& bytes, std::size_t count, int width);

}  // namespace urban_nav_store
