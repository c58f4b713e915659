// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace urban_nav_core {

/// Returns the bytes of a file, decompressed if it is one of gzip. Throws UserError as readBytes() does, and for a
/// damaged file or one that holds more than largestPiece().
std::string readUnpacked(const std::string& path);

}  // namespace urban_nav_core
