// SPDX-License-Identifier: BSD-3-Clause
// Frames after a gap that show another place: some patches resemble earlier ones, and a few are consistent with a
// motion by chance.
#include <algorithm>
#include <cmath>

#include "recordings.hpp"

namespace swf_vo {
namespace {

using urban_nav_core::StampNs;
using urban_nav_core::testing::GreyImage;
using urban_nav_core::testing::StereoFrame;

GreyImage upsideDown(GreyImage image) {
  std::reverse(image.pixels.begin(), image.pixels.end());
  return image;
}

/// The world rotated about the optical axis by 180 deg: a valid pair of another place with similar texture.
StereoFrame elsewhere(const StereoFrame& frame) {
  return {frame.stamp, upsideDown(frame.right), upsideDown(frame.left)};
}

/// Copies a part of the earlier image into that of the other place, as by an object that moves with the camera.
StereoFrame pastePiece(const StereoFrame& before, StereoFrame frame) {
  const int width = frame.left.width, height = frame.left.height;
  for (int v = height / 3; v < 2 * height / 3; ++v) {
    const auto row = v * width, first = row + width / 2, last = row + width / 2 + width / 9;
    std::copy(before.left.pixels.begin() + first, before.left.pixels.begin() + last, frame.left.pixels.begin() + first);
    std::copy(before.right.pixels.begin() + first - 40, before.right.pixels.begin() + last,
              frame.right.pixels.begin() + first - 40);
  }
  return frame;
}

TEST(Elsewhere, IsNotTakenForThePlaceOfBefore) {
  constexpr std::size_t kBefore = 15, kAfter = 5;
  constexpr StampNs kGap = 1'500'000'000, kPeriod = 50'000'000;
  int trials = 0;
  for (const char* motion : {"loop", "wander", "turns"}) {
    const Recording& room = inTheRoom(motion, 1.0, 80);
    for (std::size_t first = 0; first + kBefore + kAfter < room.frames.size(); first += 5) {
      SwfVo filter(Parameters(), room.camera, urban_nav_core::Pose());
      for (std::size_t i = 0; i < kBefore; ++i) filter.process(room.frames[first + i].pair());
      StampNs stamp = room.frames[first + kBefore - 1].stamp + kGap;
      for (std::size_t i = 0; i < kAfter; ++i, stamp += kPeriod) {
        StereoFrame other = elsewhere(room.frames[room.frames.size() - 1 - first - i]);
        if (first % 10 == 5) other = pastePiece(room.frames[first + kBefore - 1], other);
        other.stamp = stamp;
        const Frame& frame = filter.process(other.pair());
        expectProper(frame);
        if (i == 0) {
          EXPECT_EQ(frame.status.health, urban_nav_core::Health::Lost)
              << motion << " from " << first << ": " << frame.statistics.tracked << " followed";
        } else {
          EXPECT_GT(std::sqrt(frame.T_odom_base.covariance(0, 0)), 0.3) << motion << " from " << first << ", " << i;
        }
      }
      EXPECT_EQ(filter.flush().empty(), false);
      ++trials;
    }
  }
  EXPECT_GT(trials, 20);
}

}  // namespace
}  // namespace swf_vo
