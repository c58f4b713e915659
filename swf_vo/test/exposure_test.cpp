// SPDX-License-Identifier: BSD-3-Clause
// Cameras with exposure for the dark and varying saturation of bright regions: the border of a saturated region is not
// a landmark.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "recordings.hpp"
#include "urban_nav_core/trajectory/nees.hpp"

namespace swf_vo {
namespace {

using urban_nav_core::distanceBetween;
using urban_nav_core::Pose;
using urban_nav_core::testing::GreyImage;

struct ExposureOutcome {
  double squares = 0.0;  ///< mean square of the position error, m^2
  double nees = 0.0;     ///< mean
};

/// `gain`: of the light, by frame number.
template <typename Gain>
ExposureOutcome follow(const Recording& room, const Gain& gain) {
  SwfVo filter(Parameters(), room.camera, Pose());
  ExposureOutcome outcome;
  int count = 0;
  for (std::size_t i = 0; i < room.frames.size(); ++i) {
    auto frame = room.frames[i];
    for (GreyImage* image : {&frame.left, &frame.right})
      for (std::uint8_t& pixel : image->pixels)
        pixel = static_cast<std::uint8_t>(std::min(255.0, std::round(gain(static_cast<double>(i)) * pixel)));
    const Frame& now = filter.process(frame.pair());
    expectProper(now);
    if (i < 20) continue;
    ++count;
    outcome.squares += std::pow(distanceBetween(room.truth[i], now.T_odom_base.pose), 2);
    outcome.nees += urban_nav_core::nees(room.truth[i], now.T_odom_base).value_or(1e9);
  }
  outcome.squares /= count;
  outcome.nees /= count;
  return outcome;
}

TEST(ChangingExposure, IsNotTakenForMotion) {
  double usual = 0.0, changing = 0.0, nees = 0.0;
  for (const char* motion : {"loop", "turns"}) {
    const Recording& room = inTheRoom(motion, 1.0, 80);
    usual += follow(room, [](double) { return 1.0; }).squares;
    const ExposureOutcome outcome = follow(room, [](double i) { return 1.6 + 0.4 * std::sin(0.25 * i); });
    changing += outcome.squares;
    nees += outcome.nees / 2.0;
  }
  EXPECT_LT(std::sqrt(changing), 2.0 * std::sqrt(usual));
  EXPECT_LT(nees, 10.0) << "6 were right";
}

}  // namespace
}  // namespace swf_vo
