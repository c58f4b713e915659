// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/ladybug2/frame.hpp"

#include <cstring>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "segway_drivers/camera/bus_time.hpp"
#include "urban_nav_core/io/image_header.hpp"

namespace segway_drivers {

namespace {

constexpr std::uint8_t kLadybugMark[] = {0xCA, 0xFE, 0xBA, 0xBE};
constexpr std::size_t kMarkAt = 0x10, kSizeAt = 0x08, kDirectoryAt = 0x340, kJpegsAt = 0x400;
constexpr int kPlaneWidth = 512, kPlaneHeight = 384;

bool isJpeg(ByteView bytes) {
  return bytes.size > 16 && bytes[0] == 0xFF && bytes[1] == 0xD8 && std::memcmp(bytes.data + 6, "JFIF", 4) == 0;
}

ByteView ladybugPlane(ByteView frame, std::size_t total, std::size_t camera, std::size_t slot) {
  const std::uint8_t* entry = frame.data + kDirectoryAt + 32 * camera + 8 * slot;
  const std::uint64_t offset = bigWord32(entry), size = bigWord32(entry + 4);
  if (offset < kJpegsAt || offset + size > total) return {};
  const ByteView plane = frame.sub(static_cast<std::size_t>(offset), static_cast<std::size_t>(size));
  return isJpeg(plane) ? plane : ByteView();
}

}  // namespace

FrameProbe probeLadybugFrame(ByteView bytes) {
  using Kind = FrameProbe::Kind;
  for (std::size_t i = 0; i < 4; ++i) {
    if (bytes.size <= kMarkAt + i) return {Kind::Incomplete, 0};
    if (bytes[kMarkAt + i] != kLadybugMark[i]) return {Kind::NoFrame, 0};
  }
  const std::size_t total = bigWord32(bytes.data + kSizeAt);
  if (total < kJpegsAt || total > kLadybugMaxFrame) return {Kind::NoFrame, 0};
  return {bytes.size < total ? Kind::Incomplete : Kind::Frame, total};
}

std::optional<LadybugFrame> splitLadybugFrame(ByteView bytes, bool backward) {
  if (bytes.size < kJpegsAt || probeLadybugFrame(bytes).kind != FrameProbe::Kind::Frame) return std::nullopt;
  const std::size_t total = bigWord32(bytes.data + kSizeAt);
  LadybugFrame frame;
  frame.bus_time = parseBusTime(bigWord32(bytes.data));
  frame.sequence = bigWord32(bytes.data + 0x20);
  frame.pattern = parseMosaicPattern(std::string(reinterpret_cast<const char*>(bytes.data) + 0x48, 4));
  for (std::size_t camera = 0; camera < kLadybugCameras; ++camera) {
    const std::size_t listed = backward ? kLadybugCameras - 1 - camera : camera;
    for (std::size_t slot = 0; slot < kLadybugPlanes; ++slot) {
      frame.planes[camera][slot] = ladybugPlane(bytes, total, listed, slot);
      if (frame.planes[camera][slot].size == 0) ++frame.bad_channels;
    }
  }
  return frame;
}

cv::Mat decodeLadybugCamera(const LadybugFrame& frame, std::size_t camera, MosaicPattern pattern) {
  cv::Mat planes[kLadybugPlanes];
  for (std::size_t slot = 0; slot < kLadybugPlanes; ++slot) {
    const ByteView jpeg = frame.planes[camera][slot];
    if (!urban_nav_core::imageFault(jpeg.data, jpeg.size).empty()) return {};
    const cv::Mat bytes(1, static_cast<int>(jpeg.size), CV_8U, const_cast<std::uint8_t*>(jpeg.data));
    planes[slot] = cv::imdecode(bytes, cv::IMREAD_GRAYSCALE);
    if (planes[slot].cols != kPlaneWidth || planes[slot].rows != kPlaneHeight) return {};
  }
  cv::Mat upright;
  cv::rotate(combinePlanes(planes, pattern), upright, cv::ROTATE_90_CLOCKWISE);
  return upright;
}

}  // namespace segway_drivers
