// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "dense_stereo/disparity_image.hpp"
#include "padded.hpp"

namespace dense_stereo {

/// How many pixels lower the right image shows everything, from the vertical gradients of matched pixels; good to
/// some hundredths of a pixel where it is below one. Returns nullopt if fewer than a thousand pixels with texture are
/// matched.
std::optional<double> matchedRowOffset(const Padded<std::uint8_t>& left, const Padded<std::uint8_t>& right,
                                       const DisparityImage& image);

/// The same for images whose rows disagree so much that little is matched: textured blocks are searched along the
/// rows around their own. Whole pixels, up to eight. Returns nullopt if the blocks do not agree. Takes some 20 ms.
std::optional<int> searchedRowOffset(const Padded<std::uint8_t>& left, const Padded<std::uint8_t>& right,
                                     int disparities);

}  // namespace dense_stereo
