// SPDX-License-Identifier: BSD-3-Clause
#include "live/live_odometry.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <set>
#include <string>
#include <vector>

#include "live/tracks_picture.hpp"
#include "urban_nav_core/testing/rendered_sequence.hpp"
#include "urban_nav_core/testing/textured_room.hpp"

namespace swf_vo {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::StereoPairWithMotion;
using urban_nav_core::testing::RenderedSequence;

RenderedSequence liveRoom() {
  urban_nav_core::testing::SequenceOptions options;
  options.camera.fx = options.camera.fy = 260.0;
  options.camera.width = 320;
  options.camera.height = 240;
  options.camera.cx = 159.5;
  options.camera.cy = 119.5;
  return {urban_nav_core::testing::texturedRoom(), urban_nav_core::testing::loop(3.0, 1.5, 1.2, 25.0), options};
}

std::string findFigure(const urban_nav_live::StageReport& report, const std::string& name) {
  for (const auto& figure : report.figures)
    if (figure.name == name) return figure.value;
  return "absent";
}

/// A stage that records its output.
struct Recorded {
  std::vector<Frame> frames;
  std::vector<Settled> settled;
  LiveOdometry odometry{Parameters(),
                        {[this](const Frame& frame, const urban_nav_core::StereoPair&, double process_ms) {
                           frames.push_back(frame);
                           EXPECT_GE(process_ms, 0.0);
                         },
                         [this](const Settled& each) { settled.push_back(each); }, nullptr}};

  void play(RenderedSequence& sequence, int first, int count) {
    for (int i = first; i < first + count; ++i) {
      StereoPairWithMotion pair;
      pair.pair = sequence.frame(i).pair();
      odometry.process(pair);
    }
  }
};

TEST(LiveOdometry, EqualsTheFilterToTheLastBit) {
  RenderedSequence sequence = liveRoom();
  const auto camera = makeCamera(sequence.options().camera);
  Recorded live;
  live.odometry.begin(camera, Pose());
  live.play(sequence, 0, 6);
  live.odometry.end("test");
  SwfVo filter(Parameters(), camera, Pose());
  for (int i = 0; i < 6; ++i) {
    const Frame& frame = filter.process(sequence.frame(i).pair());
    ASSERT_LT(static_cast<std::size_t>(i), live.frames.size());
    const Frame& same = live.frames[static_cast<std::size_t>(i)];
    EXPECT_EQ(same.T_odom_base.pose.t(), frame.T_odom_base.pose.t());
    EXPECT_EQ(same.T_odom_base.covariance, frame.T_odom_base.covariance);
  }
  EXPECT_EQ(live.settled.size(), filter.flush().size());
}

TEST(LiveOdometry, UsesTheMotionOfSkippedPairsWithTheNextOne) {
  RenderedSequence sequence = liveRoom();
  const auto camera = makeCamera(sequence.options().camera);
  const auto motionBefore = [&](int i) {
    urban_nav_core::MotionInput input;
    input.from = sequence.stamp(i - 1);
    input.to = sequence.stamp(i);
    input.T_from_to = Pose(urban_nav_core::Quaterniond::Identity(), {0.1 * i, 0.0, 0.0});
    input.information = 1e4 * urban_nav_core::Matrix6d::Identity();
    return input;
  };
  Recorded live;
  live.odometry.begin(camera, Pose());
  live.play(sequence, 0, 1);
  StereoPairWithMotion pair;
  pair.inputs = {motionBefore(1)};
  live.odometry.process(pair, 0.9);
  ASSERT_EQ(live.frames.size(), 1u);
  pair.pair = sequence.frame(2).pair();
  pair.inputs = {motionBefore(2)};
  live.odometry.process(pair, 0.1);

  SwfVo filter(Parameters(), camera, Pose());
  filter.process(sequence.frame(0).pair());
  const Frame& frame = filter.process(sequence.frame(2).pair(), {motionBefore(1), motionBefore(2)});
  ASSERT_EQ(live.frames.size(), 2u);
  EXPECT_EQ(live.frames.back().T_odom_base.pose.t(), frame.T_odom_base.pose.t());
  EXPECT_EQ(live.frames.back().T_odom_base.covariance, frame.T_odom_base.covariance);
  const auto report = live.odometry.report();
  EXPECT_EQ(findFigure(report, "pairs skipped"), "1");
  ASSERT_FALSE(report.fault_counts.empty());
  EXPECT_EQ(report.fault_counts.front().what, "pairs were skipped");
  EXPECT_EQ(report.fault_counts.front().faults, 1);
  EXPECT_EQ(report.fault_counts.front().total, 3);
}

TEST(LiveOdometry, EachSessionStartsAtTheOrigin) {
  RenderedSequence sequence = liveRoom();
  Recorded live;
  live.odometry.begin(makeCamera(sequence.options().camera), Pose());
  live.play(sequence, 20, 3);
  live.odometry.end("the calibration changed");
  EXPECT_FALSE(live.odometry.isRunning());
  live.odometry.begin(makeCamera(sequence.options().camera), Pose());
  live.play(sequence, 0, 2);
  EXPECT_EQ(live.odometry.sessions(), 2);
  EXPECT_EQ(live.frames.back().frame, 1);
  EXPECT_LT(live.frames[3].T_odom_base.pose.t().norm(), 1e-12) << "m; but for rounding";
}

TEST(LiveOdometry, WarnsForTenSecondsOfASessionThatTheOperatorHasNotBegun) {
  RenderedSequence sequence = liveRoom();
  const auto warningsAfter = [&](const std::string& why, int frames) {
    Recorded live;
    live.odometry.begin(makeCamera(sequence.options().camera), Pose());
    live.play(sequence, 0, 1);
    EXPECT_TRUE(live.odometry.report().warnings.empty()) << "the first session";
    live.odometry.end(why);
    live.odometry.begin(makeCamera(sequence.options().camera), Pose());
    live.play(sequence, 0, 1);
    StereoPairWithMotion last;
    last.pair = sequence.frame(1).pair();
    last.pair.stamp = sequence.stamp(0) + frames * (sequence.stamp(1) - sequence.stamp(0));
    live.odometry.process(last);
    return live.odometry.report().warnings;
  };
  const int ten_seconds = static_cast<int>(10'000'000'000 / (sequence.stamp(1) - sequence.stamp(0)));
  EXPECT_EQ(warningsAfter("time went back", ten_seconds - 1),
            (std::vector<std::string>{"a new session began, because time went back"}));
  EXPECT_TRUE(warningsAfter("time went back", ten_seconds + 1).empty());
  EXPECT_TRUE(warningsAfter(LiveOdometry::kReset, 1).empty());
}

TEST(LiveOdometry, EachRoundOfARecordingHasAnIdOfItsOwn) {
  RenderedSequence sequence = liveRoom();
  Recorded live;
  EXPECT_EQ(live.odometry.session(), nullptr);
  std::set<std::string> ids;
  for (int round = 0; round < 3; ++round) {
    live.odometry.begin(makeCamera(sequence.options().camera), Pose());
    live.play(sequence, 0, 2);
    ASSERT_TRUE(live.odometry.session());
    EXPECT_EQ(live.odometry.session()->start, sequence.stamp(0));
    ids.insert(live.odometry.session()->id);
    live.odometry.end("time went back");
  }
  EXPECT_EQ(ids.size(), 3U);
}

TEST(LiveOdometry, ReportsWhyThereIsNoSession) {
  RenderedSequence sequence = liveRoom();
  Recorded live;
  EXPECT_EQ(live.odometry.report().summary, "no images yet");
  EXPECT_TRUE(live.odometry.report().is_warning);
  live.odometry.setFault("stereo: no baseline");
  EXPECT_EQ(live.odometry.report().summary, "stereo: no baseline");
  live.odometry.begin(makeCamera(sequence.options().camera), Pose());
  live.play(sequence, 0, 2);
  const auto running = live.odometry.report();
  EXPECT_EQ(running.summary, "");
  EXPECT_FALSE(running.is_warning);
  EXPECT_EQ(findFigure(running, "frames"), "2");
  EXPECT_EQ(findFigure(running, "sessions"), "1");
  live.odometry.end("reset");
  EXPECT_EQ(live.odometry.report().summary, "no session (reset)");
  live.odometry.end("again");
  EXPECT_EQ(live.odometry.report().summary, "no session (reset)") << "no session to end";
}

TEST(TracksPicture, DrawsTheImageAndItsFeatures) {
  RenderedSequence sequence = liveRoom();
  SwfVo filter(Parameters(), makeCamera(sequence.options().camera), Pose());
  TracksPicture picture(32.0);
  for (int i = 0; i < 2; ++i) {
    const auto& pair = sequence.frame(i);
    const cv::Mat& drawn = picture.draw(pair.left.view(), filter.process(pair.pair()));
    ASSERT_EQ(drawn.type(), CV_8UC3);
    EXPECT_EQ(drawn.cols, 320);
    EXPECT_EQ(drawn.rows, 240);
    std::vector<cv::Mat> channels;
    cv::split(drawn, channels);
    EXPECT_GT(cv::countNonZero(channels[0] != channels[2]), 100) << "something is coloured";
  }
  EXPECT_TRUE(picture.draw({}, Frame()).empty());
}

}  // namespace
}  // namespace swf_vo
