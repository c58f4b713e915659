// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

namespace urban_nav_input {

/// Content of metadata.yaml of a rosbag2 folder.
struct Rosbag2Metadata {
  std::vector<std::string> files;                ///< in their order, relative to the folder
  std::map<std::string, std::string> encodings;  ///< serialization_format by topic: "cdr"
  std::string compression, compression_mode;     ///< "zstd" and "FILE" or "MESSAGE"; empty: none
};

/// Reads metadata.yaml of any version from Foxy on. Throws UserError naming the file and its defect.
Rosbag2Metadata readRosbag2Metadata(const std::string& path);

}  // namespace urban_nav_input
