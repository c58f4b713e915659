// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace urban_nav_store {

/// Appends numbers as columns of bytes of equal weight, the lowest first. Each number is written as its difference from
/// the one before it, modulo 2^(8 bytes): smooth columns compress well.
void appendColumn(std::string& bytes, const std::vector<std::uint32_t>& values, int width);

/// Returns `count` numbers of appendColumn() and removes their bytes. Requires count * width bytes.
std::vector<std::uint32_t> takeColumn(std::string_view& bytes, std::size_t count, int width);

}  // namespace urban_nav_store
