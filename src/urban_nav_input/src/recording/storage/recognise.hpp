// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace urban_nav_input {

/// Storage of a recording. Packed: one of the files, compressed by zstd.
enum class StorageKind { Bag, Mcap, Db3, Rosbag2Folder, Packed };

/// Returns the storage of a path, determined by its content; nullopt for other files.
std::optional<StorageKind> recogniseStorage(const std::string& path);

/// Returns the files of rosbag2 formats in a folder (MCAP, .db3, and both compressed), by name.
std::vector<std::string> listRosbag2Files(const std::string& folder);

}  // namespace urban_nav_input
