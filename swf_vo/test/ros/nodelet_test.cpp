// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>

#include "graph.hpp"
#include "swf_vo/swf_vo.hpp"
#include "urban_nav_ros/pose.hpp"

namespace swf_vo::test {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::StereoCamera;
using urban_nav_core::testing::RenderedSequence;

// Not the identity, so that a missing transform is detected; the rotation is exact in the message and in the core.
Pose mounting() { return Pose(urban_nav_ros::opticalInBody().q(), Eigen::Vector3d(0.1, 0.06, 1.1)); }

class SwfVoNodelet : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    graph_ = new Graph;
    sequence_ = new RenderedSequence(room());
  }
  static void TearDownTestSuite() {
    delete graph_;
    delete sequence_;
  }
  void SetUp() override {
    ASSERT_TRUE(graph().connected());
    graph().place(mounting());
    ASSERT_TRUE(graph().call("reset"));
    // The frames in the window of the previous session are published first.
    ASSERT_TRUE(graph().receipts().drain({"vo/odometry", "vo/relative_pose", "vo/statistics"}));
    graph().forget();
  }
  Graph& graph() { return *graph_; }
  RenderedSequence& sequence() { return *sequence_; }
  StereoCamera camera() { return makeCamera(sequence().options().camera); }

  /// Plays frames one by one, each after the previous one was published, so that no queue overflows.
  bool play(int first, int count) {
    for (int i = first; i < first + count; ++i) {
      const std::size_t before = graph().frames.size();
      graph().publish(sequence().frame(i), camera());
      if (!Graph::until([&] { return graph().frames.size() > before; })) return false;
    }
    return true;
  }

  /// Publishes frames repeatedly, since images may overtake the first camera_info of their calibration.
  bool showUntilASessionBegins(int first, const StereoCamera& camera) {
    const std::size_t before = graph().frames.size();
    const auto began = [&] {
      return std::any_of(graph().frames.begin() + static_cast<std::ptrdiff_t>(before), graph().frames.end(),
                         [](const auto& frame) { return frame.frame == 0U; });
    };
    for (int i = first; i < first + 36 && !began(); ++i) {
      graph().publish(sequence().frame(i), camera);
      ros::WallDuration(0.1).sleep();
      ros::spinOnce();
    }
    return Graph::until(began);
  }

  static Graph* graph_;
  static RenderedSequence* sequence_;
};
Graph* SwfVoNodelet::graph_ = nullptr;
RenderedSequence* SwfVoNodelet::sequence_ = nullptr;

TEST_F(SwfVoNodelet, AgreesWithTheCoreToTheLastBit) {
  constexpr int kCount = 24;
  ASSERT_TRUE(play(0, kCount));
  ASSERT_TRUE(graph().call("reset"));  // flushes the window
  ASSERT_TRUE(Graph::until([&] { return graph().relative.size() == kCount - 1; })) << graph().relative.size();
  ASSERT_TRUE(Graph::until([&] { return graph().odometry.size() == kCount && graph().transforms.size() == kCount; }));

  SwfVo filter(Parameters(), camera(), mounting());
  std::vector<Settled> settled;
  for (int i = 0; i < kCount; ++i) {
    const Frame& frame = filter.process(sequence().frame(i).pair());
    settled.insert(settled.end(), frame.settled.begin(), frame.settled.end());
    const auto n = static_cast<std::size_t>(i);
    const nav_msgs::Odometry expected =
        urban_nav_ros::toOdometryMessage(frame.stamp, frame.T_odom_base, "odom", "base_link");
    EXPECT_EQ(graph().odometry[n].header.stamp, expected.header.stamp);
    EXPECT_EQ(graph().odometry[n].header.frame_id, "odom");
    EXPECT_EQ(graph().odometry[n].child_frame_id, "base_link");
    EXPECT_EQ(graph().odometry[n].pose.pose, expected.pose.pose);
    EXPECT_EQ(graph().odometry[n].pose.covariance, expected.pose.covariance);
    ASSERT_EQ(graph().transforms[n].transforms.size(), 1U);
    const auto& transform = graph().transforms[n].transforms[0];
    EXPECT_EQ(transform.transform, urban_nav_ros::toTransformMessage(frame.T_odom_base.pose));
    EXPECT_EQ(graph().frames[n].features, static_cast<std::uint32_t>(frame.statistics.features));
  }
  for (const Settled& rest : filter.flush()) settled.push_back(rest);
  ASSERT_EQ(settled.size(), graph().relative.size() + 1);
  for (std::size_t i = 1; i < settled.size(); ++i) {
    urban_nav_msgs::RelativePose expected = urban_nav_ros::toRelativePoseMessage(settled[i].from_previous, "base_link");
    expected.header.seq = graph().relative[i - 1].header.seq;
    expected.session = graph().relative[0].session;
    EXPECT_EQ(graph().relative[i - 1], expected) << "settled frame " << i;
  }
  EXPECT_EQ(urban_nav_ros::toStampNs(graph().relative[0].session.start), sequence().stamp(0));
  EXPECT_EQ(graph().relative[0].session.id.size(), 20U);
  EXPECT_GT(urban_nav_core::distanceBetween(settled.front().T_odom_base.pose, settled.back().T_odom_base.pose), 0.3)
      << "it did move";
}

TEST_F(SwfVoNodelet, APartnerThatDoesNotComeIsNamedWithItsDelay) {
  ASSERT_TRUE(play(0, 6));
  const auto named = [&] {
    for (const auto& array : graph().diagnostics)
      for (const auto& status : array.status) {
        const bool lags =
            status.message.find("/stereo/right/image_raw lags /stereo/left/image_raw by ") != std::string::npos;
        if (lags && status.level != diagnostic_msgs::DiagnosticStatus::OK) return true;
      }
    return false;
  };
  // A frame is published once later images show that its partner is missing.
  for (int i = 6; i < 100 && !(named() && graph().frames.size() >= 8U); ++i) {
    graph().publish(sequence().frame(i), camera(), true, false);
    ros::WallDuration(0.05).sleep();
    ros::spinOnce();
  }
  EXPECT_TRUE(named()) << (graph().diagnostics.empty() ? "no diagnostics"
                                                       : graph().diagnostics.back().status.front().message);
  ASSERT_GE(graph().frames.size(), 8U);
  EXPECT_EQ(graph().frames[7].reason_name, "image_missing");
  EXPECT_NE(graph().frames[7].status, urban_nav_msgs::VoStatistics::OK);
}

TEST_F(SwfVoNodelet, TimeGoingBackBeginsANewSession) {
  ASSERT_TRUE(play(40, 5));
  EXPECT_EQ(graph().frames.back().frame, 4U);
  ASSERT_TRUE(play(0, 5));
  EXPECT_EQ(graph().frames.back().frame, 4U) << "counts from 0 again";
  // Topics arrive independently: the frame may overtake related messages.
  const ros::Time last = urban_nav_ros::toRosTime(sequence().stamp(4));
  EXPECT_TRUE(Graph::until([&] { return !graph().odometry.empty() && graph().odometry.back().header.stamp == last; }));
  EXPECT_TRUE(Graph::until([&] { return graph().relative.size() == 4U; })) << "the session before was flushed";
}

TEST_F(SwfVoNodelet, AnotherCalibrationBeginsANewSession) {
  ASSERT_TRUE(play(0, 4));
  StereoCamera other = camera();
  other.baseline = 0.2;
  EXPECT_TRUE(showUntilASessionBegins(4, other));
  // Restores the calibration for the next test.
  EXPECT_TRUE(showUntilASessionBegins(40, camera()));
}

TEST_F(SwfVoNodelet, PauseDropsInputsAndResumeGoesOn) {
  ASSERT_TRUE(play(0, 6));
  ASSERT_TRUE(graph().call("pause"));
  for (int i = 6; i < 9; ++i) graph().publish(sequence().frame(i), camera());
  ASSERT_TRUE(Graph::until([&] { return graph().diagnosed("dropped: paused", "12"); })) << "images and camera_info";
  EXPECT_EQ(graph().frames.size(), 6U);
  ASSERT_TRUE(graph().call("resume"));
  ASSERT_TRUE(play(9, 3));
  EXPECT_EQ(graph().frames.back().frame, 8U) << "the session went on";
}

TEST_F(SwfVoNodelet, ShowsLandmarksAndTracks) {
  ASSERT_TRUE(play(0, 6));
  ASSERT_TRUE(Graph::until([&] { return graph().landmarks.size() == 6 && !graph().tracks.empty(); }));
  EXPECT_GT(graph().landmarks.back().width, 15U);
  EXPECT_EQ(graph().landmarks.back().header.frame_id, "odom");
  EXPECT_EQ(graph().tracks.back().encoding, "bgr8");
  EXPECT_EQ(graph().tracks.back().width, 320U);
  EXPECT_EQ(graph().tracks.back().height, 240U);
}

TEST_F(SwfVoNodelet, TheStatusWaitsForLateSubscribers) {
  ASSERT_TRUE(play(0, 3));
  const auto status = ros::topic::waitForMessage<urban_nav_msgs::StageStatus>("swf_vo/status", ros::Duration(60.0));
  ASSERT_TRUE(status);
  EXPECT_EQ(status->stage, "swf_vo");
}

}  // namespace
}  // namespace swf_vo::test

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "swf_vo_nodelet_test");
  ros::NodeHandle keeps_ros_alive;
  return RUN_ALL_TESTS();
}
