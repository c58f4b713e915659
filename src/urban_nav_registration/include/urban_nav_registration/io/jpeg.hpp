// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "urban_nav_core/image/view.hpp"

namespace urban_nav_registration {
/// Width and height of an image.
struct ImageSize {
  int width = 0, height = 0;  ///< px
};

/// Returns the size in the header of a JPEG; nullopt if the bytes are not a JPEG.
std::optional<ImageSize> sizeOfJpeg(const std::vector<std::uint8_t>& bytes);

/// Decodes a grey JPEG of this size. Returns an empty image if the bytes are damaged or of another size; these are not
/// decoded, so that a wrong header does not allocate memory.
cv::Mat decodeJpeg(const std::vector<std::uint8_t>& bytes, ImageSize size);

std::vector<std::uint8_t> encodeJpeg(const urban_nav_core::ImageView& image, int quality);

}  // namespace urban_nav_registration
