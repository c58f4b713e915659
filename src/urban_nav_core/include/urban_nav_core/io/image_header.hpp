// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace urban_nav_core {

/// Size of an image by the first bytes of its file, before anything is decoded.
struct ImageHeader {
  std::uint64_t width = 0, height = 0;  ///< px
  std::uint64_t bytes = 0;              ///< that a decoder takes at most for pixels and its own tables
};

/// Reads the header of a PNG, JPEG, TIFF (not BigTIFF), BMP or PNM file. Returns nullopt for other formats, and where
/// the header is cut off or damaged.
std::optional<ImageHeader> parseImageHeader(std::string_view file);

/// Returns why an image file is not decoded: it is of none of the formats of parseImageHeader(), or the decoded image
/// would exceed largestImage(). Empty if it may be decoded. Every decoder of files and messages asks this first,
/// because a file of a megabyte can hold an image of gigabytes.
std::string imageFault(std::string_view file);
std::string imageFault(const void* data, std::size_t size);

}  // namespace urban_nav_core
