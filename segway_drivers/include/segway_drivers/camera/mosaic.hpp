// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>

namespace segway_drivers {

/// Colours of a 2x2 tile in row-major order; None is a monochrome imager.
enum class MosaicPattern { None, Rggb, Gbrg, Grbg, Bggr };

/// "RGGB" ... "YYYY". Returns nullopt for other text.
std::optional<MosaicPattern> parseMosaicPattern(const std::string& text);

/// Returns the name of the pattern in sensor_msgs/Image: "bayer_rggb8", ..., "mono8".
const char* mosaicEncoding(MosaicPattern pattern);

/// Returns the BGR image of an 8-bit mosaic; the image itself if the pattern is None.
cv::Mat demosaic(const cv::Mat& mosaic, MosaicPattern pattern);

/// Returns the BGR image of half the size from the four planes of a mosaic, in the order of the tile: no interpolation,
/// greens averaged.
cv::Mat combinePlanes(const cv::Mat planes[4], MosaicPattern pattern);

}  // namespace segway_drivers
