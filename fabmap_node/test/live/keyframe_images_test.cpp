// SPDX-License-Identifier: BSD-3-Clause
#include "live/keyframe_images.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace fabmap_node {
namespace {

using urban_nav_core::StampNs;

constexpr StampNs kFramePeriod = 50'000'000, kBegin = 1'000'000'000'000;
constexpr double kFrameDistance = 0.1;  // m

StampNs toStamp(int frame) { return kBegin + frame * kFramePeriod; }
urban_nav_core::StampedPose toPose(int frame) {
  return {toStamp(frame), {urban_nav_core::Quaterniond::Identity(), {kFrameDistance * frame, 0.0, 0.0}}};
}
std::string toName(int frame) { return "frame " + std::to_string(frame); }

using Images = KeyframeImages<std::string>;

std::vector<std::string> takeAll(Images& images) {
  std::vector<std::string> taken;
  while (const auto keyframe = images.take(true)) taken.push_back(keyframe->image);
  return taken;
}

/// Frames of the keyframe selection, by the same odometry.
std::vector<std::string> selectFrom(int frames, int lost = -1) {
  urban_nav_registration::KeyframeSelector selector((urban_nav_registration::Parameters()));
  std::vector<std::string> names;
  for (int i = 0; i < frames; ++i)
    if (i != lost && selector.select(toPose(i).pose)) names.push_back(toName(i));
  return names;
}

TEST(KeyframeImages, AreThoseOfTheSelectionWhicheverArrivesFirst) {
  constexpr int kDelay = 12, kFrames = 60;
  for (const bool are_poses_late : {true, false}) {
    Images images(urban_nav_registration::Parameters(), 0);
    for (int i = 0; i < kFrames + kDelay; ++i) {
      const int late = i - kDelay;
      if (are_poses_late) {
        if (i < kFrames) images.addImage(toStamp(i), toName(i));
        if (late >= 0) images.addPose(toPose(late));
      } else {
        if (i < kFrames) images.addPose(toPose(i));
        if (late >= 0) images.addImage(toStamp(late), toName(late));
      }
    }
    EXPECT_EQ(takeAll(images), selectFrom(kFrames)) << are_poses_late;
  }
}

TEST(KeyframeImages, AFrameWithoutImageOrPoseIsLeftOut) {
  constexpr int kFrames = 40, kLost = 20;
  for (const bool is_image_lost : {true, false}) {
    Images images(urban_nav_registration::Parameters(), 0);
    for (int i = 0; i < kFrames; ++i) {
      if (i != kLost || !is_image_lost) images.addImage(toStamp(i), toName(i));
      if (i != kLost || is_image_lost) images.addPose(toPose(i));
    }
    EXPECT_EQ(takeAll(images), selectFrom(kFrames, kLost)) << is_image_lost;
  }
}

TEST(KeyframeImages, WaitForAnotherSource) {
  Images images(urban_nav_registration::Parameters(), 10 * kFramePeriod);
  for (int i = 0; i < 10; ++i) {
    images.addImage(toStamp(i), toName(i));
    images.addPose(toPose(i));
    EXPECT_FALSE(images.take()) << i;
    EXPECT_FALSE(images.isPatienceOver());
  }
  images.addImage(toStamp(10), toName(10));
  EXPECT_TRUE(images.isPatienceOver());
  ASSERT_TRUE(images.take());
}

/// The second round of a recording: stamps of images and of poses jump back, one after the other.
TEST(KeyframeImages, RoundsAreApartWhicheverJumpsFirst) {
  constexpr int kFrames = 60;
  for (const int overlap : {-7, 0, 7}) {  // frames by which images jump before poses
    Images images(urban_nav_registration::Parameters(), 0);
    std::vector<std::string> taken;
    const int image_delay = overlap < 0 ? -overlap : 0, pose_delay = overlap > 0 ? overlap : 0;
    for (int i = 0; i < 2 * kFrames + 7; ++i) {
      const int image = i - image_delay, pose = i - pose_delay;
      if (image == kFrames) {
        for (const std::string& each : takeAll(images)) taken.push_back(each);
        images.restart();
      }
      if (image >= 0 && image < 2 * kFrames) images.addImage(toStamp(image % kFrames), toName(image % kFrames));
      if (pose >= 0 && pose < 2 * kFrames) images.addPose(toPose(pose % kFrames));
    }
    for (const std::string& each : takeAll(images)) taken.push_back(each);
    std::vector<std::string> expected = selectFrom(kFrames - pose_delay);  // later poses came after the jump
    for (const std::string& each : selectFrom(kFrames)) expected.push_back(each);
    EXPECT_EQ(taken, expected) << overlap;
  }
}

}  // namespace
}  // namespace fabmap_node
