// SPDX-License-Identifier: BSD-3-Clause
#include "recording/storage/rosbag2_metadata.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cctype>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav_input {

namespace {

std::string toText(const YAML::Node& node) { return node && node.IsScalar() ? node.Scalar() : std::string(); }

std::string toCase(std::string text, int (*convert)(int)) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [&](unsigned char letter) { return static_cast<char>(convert(letter)); });
  return text;
}

}  // namespace

Rosbag2Metadata readRosbag2Metadata(const std::string& path) {
  try {
    const YAML::Node root = YAML::LoadFile(path);
    const YAML::Node bag = root.IsMap() ? root["rosbag2_bagfile_information"] : YAML::Node();
    if (!bag || !bag.IsMap())
      throw urban_nav_core::UserError(path, "has no rosbag2_bagfile_information", "metadata.yaml of rosbag2");
    Rosbag2Metadata metadata;
    metadata.compression = toCase(toText(bag["compression_format"]), std::tolower);
    metadata.compression_mode = toCase(toText(bag["compression_mode"]), std::toupper);
    if (const YAML::Node files = bag["relative_file_paths"]; files && files.IsSequence())
      for (const YAML::Node& file : files) metadata.files.push_back(toText(file));
    if (const YAML::Node topics = bag["topics_with_message_count"]; topics && topics.IsSequence())
      for (const YAML::Node& topic : topics) {
        const YAML::Node about = topic.IsMap() ? topic["topic_metadata"] : YAML::Node();
        if (about && about.IsMap()) metadata.encodings[toText(about["name"])] = toText(about["serialization_format"]);
      }
    return metadata;
  } catch (const YAML::Exception& error) {
    throw urban_nav_core::UserError(urban_nav_core::atLine(path, error.mark.line + 1), error.msg,
                                    "metadata.yaml of rosbag2");
  }
}

}  // namespace urban_nav_input
