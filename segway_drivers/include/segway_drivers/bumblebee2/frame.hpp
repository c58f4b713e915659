// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "segway_drivers/stream/bytes.hpp"
#include "segway_drivers/stream/frame_stream.hpp"

namespace segway_drivers {

constexpr int kBb2Width = 640, kBb2Height = 480;
constexpr std::size_t kBb2FrameSize = 2UL * kBb2Width * kBb2Height;  // bytes

/// Location of the embedded image information.
enum class Bb2Embedding {
  Raw,     ///< in the first raw bytes
  Imager,  ///< in the first pixels of each imager
};

/// One image of each imager.
struct Bb2Frame {
  cv::Mat left, right;                  ///< 8 bits, as sent by the imagers (a mosaic for colour cameras)
  std::optional<double> bus_time;       ///< s modulo 128
  std::uint32_t sequence = 0;           ///< frame counter
  std::uint16_t gain = 0, shutter = 0;  ///< counts
};

/// Separates the imagers and reads time, gain, shutter and frame counter (mask 0x47), whose pixels are replaced by the
/// row two below. `swap`: even bytes belong to the left imager. Requires kBb2FrameSize bytes.
Bb2Frame splitBb2Frame(ByteView raw, bool swap, Bb2Embedding embedding);

/// Framing rule of recorded raw frames of fixed size.
FrameProbe probeBb2Frame(ByteView bytes);

/// Returns the median disparity of matched corners, px: positive if left and right are not exchanged. Returns nullopt
/// if fewer than 20 corners match.
std::optional<double> medianDisparity(const cv::Mat& left, const cv::Mat& right);

}  // namespace segway_drivers
