// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "urban_nav_core/image/view.hpp"

namespace urban_nav_registration {

struct ImageSize {
  int width = 0, height = 0;  ///< px
};

/// Returns the size that the headers of a JPEG state; nullopt if the bytes are none.
std::optional<ImageSize> sizeOfJpeg(const std::vector<std::uint8_t>& bytes);

/// Returns the grey image of a JPEG of this size; empty if the bytes are damaged, something else, or of another size:
/// these are not decoded, so that a header that lies takes no memory.
cv::Mat decodeJpeg(const std::vector<std::uint8_t>& bytes, ImageSize size);

std::vector<std::uint8_t> encodeJpeg(const urban_nav_core::ImageView& image, int quality);

}  // namespace urban_nav_registration
