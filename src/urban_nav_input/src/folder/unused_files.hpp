// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>

namespace urban_nav_input {

/// Returns a sentence that names what a folder holds beside what is used: "not used: image_2/, velodyne/". Empty where
/// that is nothing. `used`: names of files and folders right in it; hidden ones are never named.
std::string describeUnusedFiles(const std::string& folder, const std::set<std::string>& used);

/// Returns the first part of a path relative to a folder: "image_00" of "folder/image_00/data". Empty for other paths.
std::string firstPartWithin(const std::string& folder, const std::string& path);

}  // namespace urban_nav_input
