// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace urban_nav_sim {

/// Returns the words between commas and blanks.
std::vector<std::string> splitWords(const std::string& text);

}  // namespace urban_nav_sim
