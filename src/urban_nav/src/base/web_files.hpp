// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

namespace urban_nav {

/// Returns a file of src/urban_nav/web, embedded in the program by the build. Throws std::out_of_range for an unknown
/// name.
std::string_view webFile(std::string_view name);

/// Returns the concatenation of several files.
std::string webFiles(std::initializer_list<const char*> names);

}  // namespace urban_nav
