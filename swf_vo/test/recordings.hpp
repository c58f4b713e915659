// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <map>
#include <string>

#include "swf_vo/swf_vo.hpp"
#include "urban_nav_core/testing/rendered_sequence.hpp"
#include "urban_nav_core/testing/sequence_folder.hpp"
#include "urban_nav_core/testing/textured_room.hpp"

namespace swf_vo {

using urban_nav_core::testing::Recording;

inline urban_nav_core::testing::RenderCamera roomCamera() { return {300.0, 300.0, 191.5, 143.5, 384, 288, 0.12, 0.5}; }

inline urban_nav_core::StereoCamera stereoCamera() {
  const auto c = roomCamera();
  return {{c.fx, c.fy, c.cx, c.cy, c.width, c.height}, c.baseline};
}

/// The room along any motion, at 20 Hz.
inline Recording inTheRoom(const urban_nav_core::testing::Motion& motion, double noise, int count) {
  urban_nav_core::testing::SequenceOptions options;
  options.camera = roomCamera();
  options.noise = noise;
  urban_nav_core::testing::RenderedSequence sequence(urban_nav_core::testing::texturedRoom(), motion, options);
  return record(sequence, count);
}

/// The room along a named motion, rendered once for all tests; it may be longer than requested.
inline const Recording& inTheRoom(const std::string& motion, double noise, int count) {
  static std::map<std::string, Recording> drawn;
  Recording& result = drawn[motion + std::to_string(noise)];
  if (static_cast<int>(result.frames.size()) < count)
    result = inTheRoom(urban_nav_core::testing::namedMotion(motion, "room", 1), noise, count);
  return result;
}

inline void expectProper(const Frame& frame) {
  EXPECT_TRUE(frame.T_odom_base.pose.isFinite()) << frame.frame;
  ASSERT_TRUE(frame.T_odom_base.covariance.allFinite()) << frame.frame;
  EXPECT_EQ(Eigen::LLT<urban_nav_core::Matrix6d>(frame.T_odom_base.covariance).info(), Eigen::Success) << frame.frame;
}

}  // namespace swf_vo
