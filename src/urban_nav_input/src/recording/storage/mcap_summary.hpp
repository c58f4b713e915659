// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "recording/storage/mcap_contents.hpp"

namespace urban_nav_input {

/// Returns the contents of an MCAP file by its summary; nullopt if it has none, if the summary's checksum is wrong, or
/// if its index does not name all messages.
std::optional<McapContents> readMcapSummary(ByteView file);

}  // namespace urban_nav_input
