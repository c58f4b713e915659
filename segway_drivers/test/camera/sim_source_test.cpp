// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/camera/sim_source.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "segway_drivers/bumblebee2/camera.hpp"
#include "segway_drivers/camera/pack_frames.hpp"
#include "segway_drivers/ladybug2/camera.hpp"

namespace segway_drivers {
namespace {

constexpr TimeNs kSimBegin = 5'000'000'000;

cv::Mat makeSimScene(int seed, cv::Size size, int type) {
  cv::Mat noise(size.height / 16, size.width / 16, type), scene;
  cv::RNG random(static_cast<std::uint64_t>(seed));
  random.fill(noise, cv::RNG::UNIFORM, 30, 220);
  cv::resize(noise, scene, size, 0.0, 0.0, cv::INTER_CUBIC);
  return scene;
}

/// A camera on a stepped clock that takes a picture every `period` s.
class SteppedCamera {
 public:
  SteppedCamera(const SimCameraOptions& options, Bytes frame, double period, int count)
      : source(
            [this, period, count]() -> std::optional<SimFrame> {
              if (sent == count) return std::nullopt;
              return SimFrame{period * sent++, frame_};
            },
            options, {[this] { return now; }, [this](TimeNs until) { now = std::max(now, until); }}),
        frame_(std::move(frame)) {}

  double seconds() const { return 1e-9 * static_cast<double>(now - kSimBegin); }

  TimeNs now = kSimBegin;
  int sent = 0;
  SimSource source;

 private:
  Bytes frame_;
};

SimCameraOptions makeStereoOptions(std::vector<SimCameraFault> faults) {
  SimCameraOptions options;
  options.bus_begin = 120.0;
  options.bus_skew = 50e-6;
  options.faults = std::move(faults);
  return options;
}

/// Output of a stereo driver for a session with faults.
struct StereoRun {
  std::vector<Bb2StampedPair> pairs;
  std::vector<double> at;  // s since the begin, of arrival
  double worst = 0.0;      // s, of a stamp against the picture's time
  int reconnections = 0, reported = 0;
  DeviceCounters counters;
};

/// Runs as a nodelet does: a camera that has vanished, or gives nothing for a second, is opened again.
StereoRun runStereo(std::vector<SimCameraFault> faults, double duration) {
  const cv::Mat left = makeSimScene(1, {kBb2Width, kBb2Height}, CV_8U), right = makeSimScene(2, left.size(), CV_8U);
  SteppedCamera stepped(makeStereoOptions(std::move(faults)), packBb2Frame(left, right), 0.05, 20 * 200);
  Bb2Camera camera(stepped.source, {});
  StereoRun run;
  std::string error;
  EXPECT_TRUE(camera.start(error)) << error;
  TimeNs last = stepped.now;
  while (stepped.seconds() < duration) {
    if (stepped.source.isGone() || stepped.now - last > 1'000'000'000) {
      stepped.now += 200'000'000;
      ++run.reported;
      if (!camera.start(error)) continue;
      ++run.reconnections;
      last = stepped.now;
    }
    auto pair = camera.next(100'000'000);
    if (!pair) continue;
    last = stepped.now;
    const double time = 1e-9 * static_cast<double>(pair->stamp - kSimBegin);
    run.worst = std::max(run.worst, std::abs(time - 0.05 * std::round(time / 0.05)));
    run.at.push_back(stepped.seconds());
    run.pairs.push_back(std::move(*pair));
  }
  run.counters = camera.counters();
  if (!run.pairs.empty()) {
    EXPECT_EQ(cv::norm(run.pairs.back().frame.left.rowRange(2, kBb2Height), left.rowRange(2, kBb2Height), cv::NORM_INF),
              0.0);
    EXPECT_EQ(
        cv::norm(run.pairs.back().frame.right.rowRange(2, kBb2Height), right.rowRange(2, kBb2Height), cv::NORM_INF),
        0.0);
  }
  return run;
}

double longestGap(const std::vector<double>& times) {
  double gap = 0.0;
  for (std::size_t i = 1; i < times.size(); ++i) gap = std::max(gap, times[i] - times[i - 1]);
  return gap;
}

TEST(SimSource, PairsKeepTheirPixelsAndTimesOverAWrapOfTheBus) {
  const StereoRun run = runStereo({}, 20.0);  // the bus wraps after 8 s
  EXPECT_GT(run.pairs.size(), 390U);
  EXPECT_LT(run.worst, 0.2e-3);
  EXPECT_EQ(run.counters.gaps, 0);
  EXPECT_EQ(run.reconnections, 0);
}

TEST(SimSource, AnUnpluggedCameraIsOpenedAgain) {
  const StereoRun run = runStereo({{SimCameraFault::Kind::Unplug, 5.0, 1.0}}, 12.0);
  EXPECT_EQ(run.reconnections, 1);
  EXPECT_LT(longestGap(run.at), 1.0 + 2.5);
  EXPECT_GT(run.at.back(), 11.0);
  EXPECT_LT(run.worst, 0.2e-3);
}

TEST(SimSource, ASilentCameraIsOpenedAgainAndNothingOldComes) {
  const StereoRun run = runStereo({{SimCameraFault::Kind::Silence, 5.0, 1.5}}, 12.0);
  EXPECT_GE(run.reported, 1);
  EXPECT_LT(longestGap(run.at), 1.5 + 2.5);
  for (std::size_t i = 0; i < run.pairs.size(); ++i)
    EXPECT_LT(run.at[i] - 1e-9 * static_cast<double>(run.pairs[i].stamp - kSimBegin), 0.5);
}

TEST(SimSource, CorruptFramesAreCountedAndNotPublished) {
  const StereoRun run = runStereo({{SimCameraFault::Kind::Corrupt, 5.0, 0.5}}, 8.0);
  EXPECT_NEAR(static_cast<double>(run.counters.bad_checksums), 10.0, 1.0);
  EXPECT_EQ(run.reconnections, 0);
  EXPECT_LT(longestGap(run.at), 0.7);
}

TEST(SimSource, APowerCycleClearsRegistersAndTheDriverRestoresThem) {
  const StereoRun run = runStereo({{SimCameraFault::Kind::Power, 5.0, 2.0}}, 14.0);
  EXPECT_EQ(run.reconnections, 1);
  EXPECT_LT(longestGap(run.at), 2.0 + 2.5);
  EXPECT_LT(run.worst, 0.2e-3);
}

TEST(SimSource, FramesOfALadybugComeBackInColour) {
  std::array<cv::Mat, 5> pictures;
  for (int i = 0; i < 5; ++i)
    if (i != 3) pictures[static_cast<std::size_t>(i)] = makeSimScene(i, {384, 512}, CV_8UC3);
  SimCameraOptions options;
  options.model = SimCameraOptions::Model::Ladybug2;
  options.bus_begin = 126.0;
  options.faults = {{SimCameraFault::Kind::Unplug, 6.0, 1.0}};
  SteppedCamera stepped(options, packLadybugFrame(pictures, 90), 0.1, 200);
  LadybugCamera::Options ladybug;
  ladybug.rate = 2.5;
  LadybugCamera camera(stepped.source, ladybug);
  std::string error;
  ASSERT_TRUE(camera.start(error)) << error;
  std::vector<LadybugStampedFrame> frames;
  while (stepped.seconds() < 15.0) {
    if (stepped.source.isGone()) {
      stepped.now += 200'000'000;
      camera.start(error);
      continue;
    }
    if (auto frame = camera.next(100'000'000)) frames.push_back(std::move(*frame));
  }
  EXPECT_NEAR(static_cast<double>(frames.size()), 14.0 / 0.3, 3.0);  // every third frame
  EXPECT_GE(camera.counters().gaps, 9);
  EXPECT_EQ(camera.badChannels(), 4 * camera.counters().frames);
  for (const LadybugStampedFrame& frame : frames) {
    const double time = 1e-9 * static_cast<double>(frame.stamp - kSimBegin);
    EXPECT_NEAR(time, 0.1 * std::round(time / 0.1), 0.2e-3);
  }
  const auto last = splitLadybugFrame(frames.back().bytes, false);
  ASSERT_TRUE(last);
  for (std::size_t i = 0; i < 5; ++i) {
    const cv::Mat image = decodeLadybugCamera(*last, i, MosaicPattern::Bggr);
    ASSERT_EQ(image.empty(), i == 3);
    if (i == 3) continue;
    EXPECT_LT(cv::norm(image, pictures[i], cv::NORM_L1) / static_cast<double>(image.total() * 3), 3.0);
  }
}

TEST(SimSource, FramesThatAreNotFetchedAreLost) {
  SteppedCamera stepped(makeStereoOptions({}), Bytes(kBb2FrameSize), 0.05, 400);
  Bb2Camera camera(stepped.source, {});
  std::string error;
  ASSERT_TRUE(camera.start(error));
  for (int i = 0; i < 40; ++i) camera.next(100'000'000);
  stepped.now += 3'000'000'000;
  for (int i = 0; i < 40; ++i) camera.next(100'000'000);
  EXPECT_NEAR(static_cast<double>(camera.counters().gaps), 52.0, 3.0);
}

TEST(SimSource, AMachineThatDecodesSlowlyDelaysTheSessionAndLosesNothing) {
  TimeNs now = kSimBegin;
  int sent = 0;
  const FrameReader read = [&]() -> std::optional<SimFrame> {
    now += 80'000'000;  // for a frame each 50 ms
    if (sent == 100) return std::nullopt;
    return SimFrame{0.05 * sent++, Bytes(kBb2FrameSize)};
  };
  SimSource source(read, makeStereoOptions({}),
                   {[&] { return now; }, [&](TimeNs until) { now = std::max(now, until); }});
  Bb2Camera camera(source, {});
  std::string error;
  ASSERT_TRUE(camera.start(error));
  int pairs = 0;
  while (!source.isFinished()) pairs += camera.next(100'000'000) ? 1 : 0;
  EXPECT_GE(pairs, 95);  // the driver needs a few to set its clock
  EXPECT_EQ(camera.counters().gaps, 0);
}

TEST(SimSource, APacedSessionLosesNothingHoweverSlowItsDriverIs) {
  SimCameraOptions options = makeStereoOptions({});
  options.is_paced = true;
  SteppedCamera stepped(options, Bytes(kBb2FrameSize), 0.05, 100);
  Bb2Camera camera(stepped.source, {});
  std::string error;
  ASSERT_TRUE(camera.start(error));
  int pairs = 0;
  for (; !stepped.source.isFinished(); stepped.now += 700'000'000) pairs += camera.next(100'000'000) ? 1 : 0;
  EXPECT_GE(pairs, 95);  // the driver needs a few to set its clock
  EXPECT_EQ(camera.counters().gaps, 0);
}

TEST(SimSource, ThereIsNoCameraBeforeTheSessionHasABegin) {
  std::optional<TimeNs> begin;
  SimCameraOptions options = makeStereoOptions({});
  options.begin = [&begin] { return begin; };
  SteppedCamera stepped(options, Bytes(kBb2FrameSize), 0.05, 100);
  Bb2Camera camera(stepped.source, {});
  std::string error;
  EXPECT_FALSE(camera.start(error));
  EXPECT_EQ(error, "the session of the simulated devices has not started");
  begin = kSimBegin;
  EXPECT_TRUE(camera.start(error)) << error;
}

TEST(SimSource, FramesFromBeforeTheStartAreNotGiven) {
  SimCameraOptions options = makeStereoOptions({});
  options.begin = [] { return kSimBegin - 2'000'000'000; };
  SteppedCamera stepped(options, Bytes(kBb2FrameSize), 0.05, 100);
  Bb2Camera camera(stepped.source, {});
  std::string error;
  ASSERT_TRUE(camera.start(error));
  int pairs = 0;
  while (!stepped.source.isFinished()) pairs += camera.next(100'000'000) ? 1 : 0;
  EXPECT_NEAR(pairs, 58, 3);  // the driver needs a few of them to set its clock
}

}  // namespace
}  // namespace segway_drivers
