// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/camera/pack_frames.hpp"

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "segway_drivers/bumblebee2/frame.hpp"

namespace segway_drivers {

namespace {

constexpr std::size_t kPackedContainer = 1'031'680, kPackedDirectory = 0x340, kPackedJpegs = 0x400;
constexpr std::array<int, 4> kChannelOfSlot = {0, 1, 1, 2};  // B G G R of BGR

cv::Mat scaleTo(const cv::Mat& image, cv::Size size) {
  if (image.size() == size) return image;
  cv::Mat scaled;
  cv::resize(image, scaled, size, 0.0, 0.0, cv::INTER_LANCZOS4);
  return scaled;
}

void storeBig32(Bytes& bytes, std::size_t at, std::uint32_t word) {
  for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<std::uint8_t>(word >> (24 - 8 * i));
}

}  // namespace

Bytes packBb2Frame(const cv::Mat& left, const cv::Mat& right) {
  const cv::Size size(kBb2Width, kBb2Height);
  cv::Mat both;
  cv::merge(std::vector<cv::Mat>{scaleTo(right, size), scaleTo(left, size)}, both);
  return Bytes(both.data, both.data + kBb2FrameSize);
}

Bytes packLadybugFrame(const std::array<cv::Mat, 5>& cameras, int quality) {
  Bytes frame(kPackedJpegs, 0);
  const std::array<std::uint8_t, 8> mark = {0xCA, 0xFE, 0xBA, 0xBE, 0, 0, 0, 2}, pattern = {'B', 'G', 'G', 'R'};
  std::copy(mark.begin(), mark.end(), frame.begin() + 0x10);
  std::copy(pattern.begin(), pattern.begin() + 4, frame.begin() + 0x48);
  for (std::size_t camera = 0; camera < cameras.size(); ++camera) {
    if (cameras[camera].empty()) continue;
    cv::Mat lying, planes[3];
    cv::rotate(cameras[camera], lying, cv::ROTATE_90_COUNTERCLOCKWISE);
    cv::split(scaleTo(lying, {512, 384}), planes);
    for (std::size_t slot = 0; slot < 4; ++slot) {
      Bytes jpeg;
      cv::imencode(".jpg", planes[kChannelOfSlot[slot]], jpeg, {cv::IMWRITE_JPEG_QUALITY, quality});
      const std::size_t entry = kPackedDirectory + 32 * camera + 8 * slot;
      storeBig32(frame, entry, static_cast<std::uint32_t>(frame.size()));
      storeBig32(frame, entry + 4, static_cast<std::uint32_t>(jpeg.size()));
      frame.insert(frame.end(), jpeg.begin(), jpeg.end());
    }
  }
  storeBig32(frame, 0x08, static_cast<std::uint32_t>(frame.size()));
  frame.resize(std::max(frame.size(), kPackedContainer), 0);
  return frame;
}

}  // namespace segway_drivers
