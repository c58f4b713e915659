// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "recording/storage/bag_scan.hpp"

namespace urban_nav_input {

/// Reads the index of a ROS 1 bag: connections, chunks, and the index records after each chunk; nothing is
/// decompressed. Connections without messages are left out, the others are in the order of their ids. Returns nullopt
/// if the recorder did not finish the bag, or where a length, a place or a count is not what the file holds: its
/// records are read then instead (scanBag()). Requires that the file begins with rosbag1::kMagic.
std::optional<BagScan> readBagIndex(ByteView file);

}  // namespace urban_nav_input
