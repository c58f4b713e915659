// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

namespace urban_nav {

/// Returns a file of src/urban_nav/web, which the build embeds in the program. Throws std::out_of_range for a name that
/// is not there.
std::string_view webFile(std::string_view name);

/// Returns several of them, one after another.
std::string webFiles(std::initializer_list<const char*> names);

}  // namespace urban_nav
