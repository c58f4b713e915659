// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace urban_nav_core {

/// Size of an image from the first bytes of its file, without decoding.
struct ImageHeader {
  std::uint64_t width = 0, height = 0;  ///< px
  std::uint64_t bytes = 0;              ///< upper limit of a decoder's memory for pixels and tables
};

/// Reads the header of a PNG, JPEG, TIFF (not BigTIFF), BMP or PNM file. Returns nullopt for other formats, and where
/// the header is cut off or damaged.
std::optional<ImageHeader> parseImageHeader(std::string_view file);

/// Returns why an image file must not be decoded: its format is not one of parseImageHeader(), or the decoded image
/// would exceed largestImage(). Empty if it may be decoded. Must be called before every decoder of files and messages,
/// because a file of a megabyte can hold an image of gigabytes.
std::string imageFault(std::string_view file);
std::string imageFault(const void* data, std::size_t size);

}  // namespace urban_nav_core
