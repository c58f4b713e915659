// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/camera/record_frames.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "segway_drivers/bumblebee2/camera.hpp"
#include "segway_drivers/camera/bus_time.hpp"
#include "segway_drivers/camera/pack_frames.hpp"
#include "urban_nav_core/types/error.hpp"

namespace segway_drivers {
namespace {

constexpr TimeNs kRecordedBegin = 1'257'000'000'000'000'000, kRecordedPeriod = 50'000'000;

/// Ten seconds of a Bumblebee2 at 20 Hz with faults.
std::vector<RecordedFrame> recordStereo(std::vector<SimCameraFault> faults, const std::function<bool()>& stop) {
  int sent = 0;
  const FrameReader read = [&sent]() -> std::optional<SimFrame> {
    if (sent == 200) return std::nullopt;
    const TimeNs time = kRecordedPeriod * sent++;
    return SimFrame{1e-9 * static_cast<double>(time), Bytes(kBb2FrameSize, 9), kRecordedBegin + time};
  };
  SimCameraOptions options;
  options.bus_begin = 125.0;
  options.faults = std::move(faults);
  std::vector<RecordedFrame> frames;
  const std::int64_t count = recordFrames(
      read, options, [&](const RecordedFrame& frame) { frames.push_back(frame); }, stop);
  EXPECT_EQ(count, static_cast<std::int64_t>(frames.size()));
  return frames;
}

std::vector<RecordedFrame> recordStereo(std::vector<SimCameraFault> faults) {
  return recordStereo(std::move(faults), [] { return false; });
}

TEST(RecordFrames, AFrameCarriesItsCounterAndTheTimeOfTheBus) {
  const std::vector<RecordedFrame> frames = recordStereo({});
  ASSERT_EQ(frames.size(), 200U);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const RecordedFrame& frame = frames[i];
    EXPECT_EQ(frame.sequence, i);
    EXPECT_EQ(frame.time, kRecordedBegin + kRecordedPeriod * static_cast<TimeNs>(i));
    EXPECT_NEAR(static_cast<double>(frame.arrival - frame.time), 20e6, 1e3);
    EXPECT_FALSE(frame.corrupt);
    const auto bus = splitBb2Frame(frame.bytes, false, Bb2Embedding::Raw).bus_time;
    ASSERT_TRUE(bus);
    EXPECT_NEAR(std::remainder(*bus - (125.0 + 0.05 * static_cast<double>(i)), kBusTimeWrap), 0.0, 1e-6);
  }
}

TEST(RecordFrames, FramesOfALossAreMissing) {
  const std::vector<RecordedFrame> frames = recordStereo({{SimCameraFault::Kind::Unplug, 4.0, 2.0}});
  EXPECT_NEAR(static_cast<double>(frames.size()), 160.0, 1.0);
  for (const RecordedFrame& frame : frames) {
    const double t = 1e-9 * static_cast<double>(frame.time - kRecordedBegin);
    EXPECT_TRUE(t < 4.0 || t >= 6.0) << t;
    EXPECT_EQ(frame.sequence, static_cast<std::uint32_t>(std::lround(t / 0.05)));
  }
}

TEST(RecordFrames, TheCounterBeginsAgainAfterALossOfPower) {
  const std::vector<RecordedFrame> frames = recordStereo({{SimCameraFault::Kind::Power, 4.0, 2.0}});
  ASSERT_GT(frames.size(), 150U);
  EXPECT_LT(frames.back().sequence, 130U);
  // The registers that embed information were lost as well, and have been set again.
  EXPECT_TRUE(splitBb2Frame(frames.back().bytes, false, Bb2Embedding::Raw).bus_time);
}

TEST(RecordFrames, ASessionMayBeginOrEndWithoutACamera) {
  const std::vector<RecordedFrame> late = recordStereo({{SimCameraFault::Kind::Unplug, 0.0, 3.0}});
  EXPECT_NEAR(static_cast<double>(late.size()), 140.0, 1.0);
  const std::vector<RecordedFrame> early = recordStereo({{SimCameraFault::Kind::Unplug, 3.0, 1e12}});
  EXPECT_NEAR(static_cast<double>(early.size()), 60.0, 1.0);
}

TEST(RecordFrames, CorruptFramesAreMarked) {
  for (const RecordedFrame& frame : recordStereo({{SimCameraFault::Kind::Corrupt, 4.0, 2.0}})) {
    const double t = 1e-9 * static_cast<double>(frame.time - kRecordedBegin);
    EXPECT_EQ(frame.corrupt, t > 3.999 && t < 5.999) << t;
  }
}

TEST(RecordFrames, AnEmptySessionIsRefusedAndAStopEndsIt) {
  const FrameReader none = []() -> std::optional<SimFrame> { return std::nullopt; };
  EXPECT_THROW(recordFrames(
                   none, {}, [](const RecordedFrame&) {}, [] { return false; }),
               urban_nav_core::DataError);
  int calls = 0;
  EXPECT_EQ(recordStereo({}, [&calls] { return ++calls > 10; }).size(), 10U);
}

}  // namespace
}  // namespace segway_drivers
