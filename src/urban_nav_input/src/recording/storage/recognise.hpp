// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace urban_nav_input {

/// Storage of a recording. Packed: one of the files, compressed by zstd.
enum class StorageKind { Bag, Mcap, Db3, Rosbag2Folder, Packed };

/// Returns the storage of what lies at a path, by its content alone; nullopt for anything else.
std::optional<StorageKind> recogniseStorage(const std::string& path);

/// Returns the files in a folder that rosbag2 may have written (MCAP, .db3, and both compressed), by name.
std::vector<std::string> listRosbag2Files(const std::string& folder);

}  // namespace urban_nav_input
