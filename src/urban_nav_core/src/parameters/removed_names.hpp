// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace urban_nav_core {

/// Returns a note for the user on a removed parameter without successor ("swf_vo.subpixel"); "" for any other name.
/// Renamed parameters are in the tables (Row::old_names).
std::string findReplacement(const std::string& full_name);

}  // namespace urban_nav_core
