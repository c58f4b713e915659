// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <optional>

#include "segway_drivers/camera/mosaic.hpp"
#include "segway_drivers/stream/bytes.hpp"
#include "segway_drivers/stream/frame_stream.hpp"

namespace segway_drivers {

constexpr std::size_t kLadybugCameras = 6, kLadybugPlanes = 4;
constexpr std::size_t kLadybugMaxFrame = 2'022'400;  // bytes, the largest container

/// Header of a frame and directory of its grey JPEGs. Views into the bytes of the frame.
struct LadybugFrame {
  std::optional<double> bus_time;  ///< s modulo 128
  std::uint32_t sequence = 0;      ///< frames since power-on of the head
  std::optional<MosaicPattern> pattern;
  std::array<std::array<ByteView, kLadybugPlanes>, kLadybugCameras> planes;  ///< empty: bad or missing
  int bad_channels = 0;
};

/// Parses a frame from the bus. `backward`: the directory lists camera 5 first. Returns nullopt without the header
/// mark, or if the stated size exceeds the bytes. A bad channel does not affect others.
std::optional<LadybugFrame> splitLadybugFrame(ByteView bytes, bool backward);

/// Framing rule of consecutive containers, also of .pgr files, whose frames have the same format.
FrameProbe probeLadybugFrame(ByteView bytes);

/// Returns the upright colour image at half resolution (384x512); empty if a channel of the camera is bad or cannot be
/// decoded.
cv::Mat decodeLadybugCamera(const LadybugFrame& frame, std::size_t camera, MosaicPattern pattern);

}  // namespace segway_drivers
