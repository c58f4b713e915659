// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace laser_mapper {

/// Colour of a point in an image.
struct ColourObservation {
  std::size_t view = 0, point = 0;
  std::array<float, 3> colour{};  ///< blue, green, red, each above 0
};

/// Returns factors that equalise the images' colours on common points, by alternating medians of the ratios to the
/// points' mean colours. The median factor of all images with observations is 1 in each channel; images without
/// observations have 1.
std::vector<std::array<float, 3>> estimateGains(std::size_t views, std::size_t points,
                                                const std::vector<ColourObservation>& observations);

}  // namespace laser_mapper
