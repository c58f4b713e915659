// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>

namespace urban_nav_input {

/// Returns a sentence on the unused content of a folder: "not used: image_2/, velodyne/"; empty if all is used. `used`:
/// names of files and folders directly in it; hidden ones are not reported.
std::string describeUnusedFiles(const std::string& folder, const std::set<std::string>& used);

/// Returns the first part of a path relative to a folder: "image_00" of "folder/image_00/data". Empty for other paths.
std::string firstPartWithin(const std::string& folder, const std::string& path);

}  // namespace urban_nav_input
