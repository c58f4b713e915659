// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_input::testing {

/// Messages by topic: receipt, and the serialization of ROS 1 with Header.seq 0.
using Contents = std::map<std::string, std::vector<std::pair<urban_nav_core::StampNs, std::vector<std::uint8_t>>>>;

constexpr int kSamples = 40;  ///< messages of each topic of writeSampleBag(), but for one of /tf_static

/// Writes a bag with images, rates, texts and static transforms; some are received at the same time.
void writeSampleBag(const std::string& path);

/// Returns what a recording of any storage holds of the types of writeSampleBag().
Contents readContents(const std::string& path);

/// Form of an MCAP file.
struct McapForm {
  std::string compression;  ///< "", "lz4", "zstd"
  bool is_chunked = true, has_indexes = true, has_summary = true;
};
/// Returns an MCAP file that McapWriter wrote in another form.
std::string rewriteMcap(const std::string& mcap, const McapForm& form);

/// Returns the number of chunks of an MCAP file.
std::size_t countChunks(const std::string& mcap);

/// Writes the messages of an MCAP file as rosbag2 of Humble does (`schema` 3), or of Iron (4), with definitions.
void writeDb3(const std::string& mcap_path, const std::string& path, int schema, bool is_packed = false);

}  // namespace urban_nav_input::testing
