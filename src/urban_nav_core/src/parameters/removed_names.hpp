// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace urban_nav_core {

/// Returns what takes the place of a parameter of earlier versions that has no successor ("swf_vo.subpixel"), for the
/// user; "" for any other name. Renamed parameters are in the tables (Row::old_names).
std::string findReplacement(const std::string& full_name);

}  // namespace urban_nav_core
