// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "dense_stereo/disparity_image.hpp"
#include "padded.hpp"

namespace dense_stereo {

/// Returns by how many pixels the right image is shifted down, from the vertical gradients of matched pixels; accurate
/// to some hundredths of a pixel below one pixel. nullopt if fewer than a thousand pixels with texture are matched.
std::optional<double> matchedRowOffset(const Padded<std::uint8_t>& left, const Padded<std::uint8_t>& right,
                                       const DisparityImage& image);

/// Returns the row offset of images whose rows are so misaligned that few pixels match: textured blocks are searched in
/// the rows around their own. Integer, up to eight pixels. nullopt if the blocks do not agree. Takes about 20 ms.
std::optional<int> searchedRowOffset(const Padded<std::uint8_t>& left, const Padded<std::uint8_t>& right,
                                     int disparities);

}  // namespace dense_stereo
