// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "recording/storage/mcap_contents.hpp"

namespace urban_nav_input {

/// Returns the contents of an MCAP file by its summary; nullopt without a summary, for a wrong checksum, or if
/// its index is incomplete.
std::optional<McapContents> readMcapSummary(ByteView file);

}  // namespace urban_nav_input
