// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/sequence/right_camera_turns.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <vector>

namespace urban_nav_core {
namespace {

class SteppedImages : public ::testing::Test {
 protected:
  SteppedImages() : pixels_(std::make_shared<std::vector<std::uint8_t>>(128 * 96, std::uint8_t{0})) {
    for (std::size_t i = 0; i < pixels_->size(); ++i) (*pixels_)[i] = i % 128 < 64 ? 20 : 220;
  }
  StereoPairWithMotion pairAt(StampNs stamp) const {
    StereoPairWithMotion frame;
    const ImageView image{pixels_->data(), 128, 96, 128};
    frame.pair = {stamp, image, image};
    frame.left_owner = frame.right_owner = pixels_;
    return frame;
  }
  /// Returns the column of the step from dark to bright in the right image.
  int step(RightCameraTurns& turns, StampNs stamp) const {
    StereoPairWithMotion frame = pairAt(stamp);
    turns.correct(frame);
    EXPECT_EQ(frame.pair.left.data, pixels_->data());
    int u = 0;
    while (frame.pair.right.at(u, 48) < 120) ++u;
    return u;
  }
  const StereoCamera camera_{{100.0, 100.0, 63.5, 47.5, 128, 96}, 0.1, 0.0};
  std::shared_ptr<std::vector<std::uint8_t>> pixels_;
};

TEST_F(SteppedImages, AreCorrectedByTheTurnOfTheirTime) {
  RightCameraTurns turns(camera_);
  turns.add({100, Vector3d::Zero()});
  turns.add({200, Vector3d(0.0, 0.1, 0.0)});  // the camera turned right: the scene moved left by 10 px
  turns.add({300, Vector3d(0.0, 0.1, 0.0)});
  turns.add({400, Vector3d::Zero()});
  EXPECT_EQ(step(turns, 150), 64);
  EXPECT_EQ(step(turns, 200), 74);
  EXPECT_EQ(step(turns, 399), 74);
  EXPECT_EQ(step(turns, 450), 64);
}

TEST_F(SteppedImages, IgnoreTurnsThatAreInvalid) {
  RightCameraTurns turns(camera_);
  turns.add({100, Vector3d(0.0, std::numeric_limits<double>::quiet_NaN(), 0.0)});
  EXPECT_EQ(step(turns, 150), 64);
  turns.add({200, Vector3d(0.0, 0.1, 0.0)});
  turns.add({200, Vector3d::Zero()});
  turns.add({100, Vector3d::Zero()});
  EXPECT_EQ(step(turns, 250), 74);
}

TEST_F(SteppedImages, OutliveThePairTheyWereMadeOf) {
  RightCameraTurns turns(camera_);
  turns.add({100, Vector3d(0.0, 0.1, 0.0)});
  StereoPairWithMotion first = pairAt(150), second = pairAt(160);
  turns.correct(first);
  turns.correct(second);
  EXPECT_NE(first.pair.right.data, second.pair.right.data);
  EXPECT_EQ(first.right_owner.use_count(), 1);
}

}  // namespace
}  // namespace urban_nav_core
