// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "recording/storage/bag_scan.hpp"

namespace urban_nav_input {

/// Reads the index of a ROS 1 bag: connections, chunks, and the index records after each chunk, without decompression.
/// Omits connections without messages; the others are in the order of their ids. Returns nullopt if the recorder did
/// not finish the bag, or if a length, a position or a count is inconsistent with the file, which must then be read by
/// scanBag(). Requires that the file begins with rosbag1::kMagic.
std::optional<BagScan> readBagIndex(ByteView file);

}  // namespace urban_nav_input
