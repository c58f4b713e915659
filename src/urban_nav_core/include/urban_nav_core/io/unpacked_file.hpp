// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace urban_nav_core {

/// Returns the bytes of a file, decompressed if it is in gzip format. Throws UserError as readBytes() does, and for a
/// damaged file or one that decompresses to more than largestPiece().
std::string readUnpacked(const std::string& path);

}  // namespace urban_nav_core
