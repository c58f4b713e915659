// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <ros/master.h>
#include <ros/network.h>
#include <sys/resource.h>
#include <xmlrpcpp/XmlRpc.h>

#include <algorithm>
#include <cstdlib>
#include <map>

#include "loop_metric/evidence.hpp"
#include "loop_metric/place/stored_place_data.hpp"
#include "robot.hpp"
#include "urban_nav_registration/keyframe/keyframe_extractor.hpp"
#include "urban_nav_registration/keyframe/keyframe_selector.hpp"
#include "urban_nav_registration/session/stored_keyframe.hpp"
#include "urban_nav_store/store.hpp"

namespace loop_metric::test {
namespace {

using urban_nav_msgs::MetricClosure;
using urban_nav_registration::KeyframeExtractor;
using urban_nav_registration::KeyframeSelector;
using urban_nav_registration::kKeyframeCamera;
using urban_nav_registration::toStoredKeyframe;
using urban_nav_store::Access;
using urban_nav_store::Store;

pid_t findProcess(const std::string& node) {
  const auto ask = [](const std::string& host, std::uint32_t port, const char* method, const char* argument) {
    XmlRpc::XmlRpcValue question, answer;
    question[0] = "test";
    if (argument != nullptr) question[1] = argument;
    XmlRpc::XmlRpcClient client(host.c_str(), static_cast<int>(port));
    EXPECT_TRUE(client.execute(method, question, answer)) << method;
    return answer;
  };
  XmlRpc::XmlRpcValue uri = ask(ros::master::getHost(), ros::master::getPort(), "lookupNode", node.c_str());
  std::string host;
  std::uint32_t port = 0;
  EXPECT_TRUE(ros::network::splitURI(static_cast<std::string>(uri[2]), host, port));
  return static_cast<int>(ask(host, port, "getPid", nullptr)[2]);
}

/// Prevents the growth of any file of this process during its lifetime.
class FullDisk {
 public:
  explicit FullDisk(pid_t process) : process_(process) {
    EXPECT_EQ(::prlimit(process_, RLIMIT_FSIZE, nullptr, &before_), 0);
    rlimit limit = before_;
    limit.rlim_cur = 50'000;
    EXPECT_EQ(::prlimit(process_, RLIMIT_FSIZE, &limit, nullptr), 0);
  }
  ~FullDisk() { ::prlimit(process_, RLIMIT_FSIZE, &before_, nullptr); }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  const pid_t process_;
  rlimit before_{};
};

class LoopMetricNodelet : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { robot_ = new Robot; }
  static void TearDownTestSuite() { delete robot_; }
  void SetUp() override {
    ASSERT_TRUE(robot().connected());
    ASSERT_TRUE(robot().call("reset"));
    robot().beginSession();
    robot().forget();
  }
  Robot& robot() { return *robot_; }

  std::string storePath() {
    std::string path;
    EXPECT_TRUE(ros::param::get("/loop_metric/store", path));
    return path;
  }
  std::string toId(StampNs first) { return urban_nav_store::makeSessionId({"lisa", "", first, ""}); }
  void expectTrue(const MetricClosure& closure, int a, int b) {
    EXPECT_EQ(closure.verdict, MetricClosure::ACCEPTED) << closure.reason_name << ": " << closure.message;
    EXPECT_EQ(closure.method, MetricClosure::STEREO);
    EXPECT_EQ(closure.source, "loop_metric");
    const Pose T_a_b = *urban_nav_ros::toPose(closure.T_a_b);
    const Pose truth = robot().T_world_base(a).inverse() * robot().T_world_base(b);
    EXPECT_LT(urban_nav_core::distanceBetween(T_a_b, truth), 0.03);
    EXPECT_LT(urban_nav_core::angleBetween(T_a_b, truth), 0.005);
    EXPECT_FALSE(parseEvidence(closure.evidence).tries.empty());
  }
  void expectRejected(const MetricClosure& closure, const std::string& reason) {
    EXPECT_EQ(closure.verdict, MetricClosure::REJECTED);
    EXPECT_EQ(closure.reason_name, reason) << closure.message;
    EXPECT_FALSE(closure.message.empty());
    for (const double each : closure.information) EXPECT_EQ(each, 0.0);
  }

  /// Returns the share of pixels with the most frequent blue value.
  static double measurePlainShare(const sensor_msgs::Image& picture) {
    std::map<std::uint8_t, double> levels;
    for (std::size_t i = 0; i < picture.data.size(); i += 3) levels[picture.data[i]] += 1.0;
    double most = 0.0;
    for (const auto& [level, count] : levels) most = std::max(most, count);
    return 3.0 * most / static_cast<double>(picture.data.size());
  }

  static Robot* robot_;
};
Robot* LoopMetricNodelet::robot_ = nullptr;

TEST_F(LoopMetricNodelet, ARevisitIsUpgradedAndAFalsePairIsNot) {
  robot().drive(0, kLap + 7);
  robot().recognise(3, kLap + 3);
  robot().recognise(3, 15);  // the opposite side of the room
  ASSERT_TRUE(robot().judged(2));
  const bool in_order = robot().closures[0].b.stamp == urban_nav_ros::toRosTime(robot().toStamp(kLap + 3));
  const MetricClosure &right = robot().closures[in_order ? 0 : 1], &wrong = robot().closures[in_order ? 1 : 0];
  expectTrue(right, 3, kLap + 3);
  EXPECT_TRUE(right.odometry_gate);
  EXPECT_EQ(right.a.session, "") << "who names no session means the running one";
  EXPECT_EQ(right.a.stamp, urban_nav_ros::toRosTime(robot().toStamp(3)));
  EXPECT_DOUBLE_EQ(right.probability, 0.99);
  expectRejected(wrong, "nothing_kept");  // by odometry, no two keyframes have a common view
  ASSERT_TRUE(Robot::until([&] { return !robot().pictures.empty(); }));
  EXPECT_EQ(robot().pictures.front().encoding, "bgr8");
  EXPECT_GE(robot().pictures.front().width, 2U * 512U);
  EXPECT_EQ(robot().pictures.front().data.size(), robot().pictures.front().step * robot().pictures.front().height);
  EXPECT_LT(measurePlainShare(robot().pictures.front()), 0.3) << "views instead of panels without images";
  EXPECT_TRUE(Robot::until([&] { return robot().diagnosed("accepted by stereo", "1"); }));
}

TEST_F(LoopMetricNodelet, TheViewsThatAreKeptAreThoseOfTheSameFramesOffline) {
  constexpr int kCount = 12;
  robot().drive(0, kCount);
  KeyframeSelector selector((urban_nav_registration::Parameters()));
  const KeyframeExtractor extractor(robot().camera(), urban_nav_registration::Parameters().points);
  std::vector<urban_nav_store::StoredKeyframe> expected;
  for (int i = 0; i < kCount; ++i) {
    if (!selector.select(robot().T_world_base(0).inverse() * robot().T_world_base(i))) continue;
    urban_nav_core::testing::StereoFrame frame = robot().frame(i);
    frame.stamp = robot().toStamp(i);
    expected.push_back(toStoredKeyframe(extractor.extract({"", frame.stamp}, frame.pair())));
  }
  ASSERT_TRUE(Robot::until([&] { return robot().diagnosis("session") == toId(robot().toStamp(0)); }));
  const auto stored = [&] {
    Store store(storePath(), Access::Read);
    return store.keyframes().stamps(toId(robot().toStamp(0)), kKeyframeCamera);
  };
  ASSERT_TRUE(Robot::until([&] { return stored().size() >= expected.size(); })) << stored().size();
  Store store(storePath(), Access::Read);
  EXPECT_EQ(stored().size(), expected.size());
  for (const urban_nav_store::StoredKeyframe& view : expected)
    EXPECT_TRUE(store.keyframes().get(toId(robot().toStamp(0)), kKeyframeCamera, view.stamp) == view) << view.stamp;
}

TEST_F(LoopMetricNodelet, MomentsThatAreNotKnownAreNamed) {
  robot().recognise(0, 5);  // without odometry it waits for the timeout by the clock
  ASSERT_TRUE(robot().judged(1));
  expectRejected(robot().closures[0], "unknown_moment");
  robot().drive(0, 8);
  robot().recognise({"", robot().toStamp(0) - 500 * 1'000'000'000LL}, {"", robot().toStamp(2)});
  ASSERT_TRUE(robot().judged(2));
  expectRejected(robot().closures[1], "unknown_moment");
  robot().recognise({"0123456789abcdef0123", robot().toStamp(0)}, {"", robot().toStamp(2)});
  ASSERT_TRUE(robot().judged(3));
  expectRejected(robot().closures[2], "unknown_moment");
  EXPECT_EQ(robot().closures[2].a.session, "0123456789abcdef0123");
}

TEST_F(LoopMetricNodelet, WithoutImagesThereIsNothingToGoBy) {
  robot().drive(0, kLap + 8, false);
  robot().recognise(2, kLap + 2);
  ASSERT_TRUE(robot().judged(1));
  expectRejected(robot().closures[0], "nothing_kept");
}

TEST_F(LoopMetricNodelet, AfterAGapInOdometryViewsAloneDecide) {
  robot().drive(0, kLap + 7, true, 12);
  robot().recognise(3, kLap + 3);
  ASSERT_TRUE(robot().judged(1));
  expectTrue(robot().closures[0], 3, kLap + 3);
  EXPECT_FALSE(robot().closures[0].odometry_gate);
  robot().recognise(3, 15);
  ASSERT_TRUE(robot().judged(2));
  expectRejected(robot().closures[1], "not_registered");
  for (const auto& each : parseEvidence(robot().closures[0].evidence).tries) EXPECT_EQ(each.keyframe_a.session, "");
}

TEST_F(LoopMetricNodelet, AResetEvaluatesWaitingCandidates) {
  robot().drive(0, 4);
  ASSERT_TRUE(robot().receipts().await({{"places/closure", 1}}, [&] { robot().recognise(0, 3); }));
  ASSERT_TRUE(robot().call("reset"));
  ASSERT_TRUE(robot().judged(1));
  EXPECT_EQ(robot().closures[0].b.stamp, urban_nav_ros::toRosTime(robot().toStamp(3)));
}

TEST_F(LoopMetricNodelet, APauseDropsCandidatesAndCountsThem) {
  robot().drive(0, 4);
  ASSERT_TRUE(robot().call("pause"));
  ASSERT_TRUE(Robot::until([&] { return robot().diagnosis("reason") == "None"; }));
  const long before = std::atol(robot().diagnosis("dropped: paused").c_str());
  robot().recognise(0, 3);
  EXPECT_TRUE(Robot::until([&] { return std::atol(robot().diagnosis("dropped: paused").c_str()) == before + 1; }));
  ASSERT_TRUE(robot().call("resume"));
  EXPECT_TRUE(robot().closures.empty());
}

TEST_F(LoopMetricNodelet, LasersThatDoNotComeAreNamed) {
  robot().drive(0, 4);
  ASSERT_TRUE(Robot::until([&] { return robot().diagnosis("reason") == "NoLasers"; }));
  ASSERT_TRUE(
      Robot::until([&] { return !robot().statuses.empty() && robot().statuses.back().reason_name == "NoLasers"; }));
  const auto& status = robot().statuses.back();
  EXPECT_EQ(status.stage, "loop_metric");
  EXPECT_EQ(status.status, urban_nav_msgs::StageStatus::DEGRADED);
  EXPECT_NE(status.message.find("/laser_left/scan has not been received yet"), std::string::npos) << status.message;
}

TEST_F(LoopMetricNodelet, AFullDiskIsNamedAndWhatWaitedForItIsNotLost) {
  {
    const FullDisk disk(findProcess("/loop_metric"));
    robot().drive(0, kLap + 7);
    ASSERT_TRUE(Robot::until([&] { return robot().diagnosis("reason") == "NotStored"; }));
    robot().recognise(3, kLap + 3);
    ASSERT_TRUE(robot().judged(1));
    EXPECT_EQ(robot().closures[0].verdict, MetricClosure::REJECTED);
    EXPECT_NE(robot().closures[0].message.find("the disk is full"), std::string::npos) << robot().closures[0].message;
    ASSERT_TRUE(
        Robot::until([&] { return !robot().statuses.empty() && robot().statuses.back().reason_name == "NotStored"; }));
    const auto& status = robot().statuses.back();
    EXPECT_EQ(status.status, urban_nav_msgs::StageStatus::DEGRADED);
    EXPECT_NE(status.message.find("the disk is full"), std::string::npos) << status.message;
    EXPECT_TRUE(
        Robot::until([&] { return std::atol(robot().diagnosis("store: writes that wait").c_str()) > kLap / 2; }));
    EXPECT_EQ(robot().diagnosis("store: writes lost"), "0");
  }
  ASSERT_TRUE(Robot::until([&] { return robot().diagnosis("reason") != "NotStored"; }));
  EXPECT_EQ(robot().diagnosis("store: fault"), "");
  robot().recognise(3, kLap + 3);
  ASSERT_TRUE(robot().judged(2));
  expectTrue(robot().closures[1], 3, kLap + 3);
}

TEST_F(LoopMetricNodelet, AnEarlierSessionOfTheStoreIsKnownAgain) {
  robot().drive(0, kLap / 3);
  const std::string earlier = toId(robot().toStamp(0));
  const StampNs there = robot().toStamp(5);
  ASSERT_TRUE(Robot::until([&] { return robot().diagnosis("session") == earlier; }));
  ASSERT_TRUE(robot().call("reset"));
  ASSERT_EQ(std::system("rosnode kill /loop_metric > /dev/null 2>&1"), 0);
  ASSERT_TRUE(Robot::until([&] { return !robot().isConnected(); }));
  ASSERT_TRUE(Robot::until([&] { return robot().isConnected() && ros::service::exists("loop_metric/reset", false); }));
  robot().forget();
  robot().beginSession();
  robot().drive(0, kLap / 3);
  ASSERT_TRUE(Robot::until([&] { return robot().diagnosis("session") == toId(robot().toStamp(0)); }));
  robot().recognise({earlier, there}, {"", robot().toStamp(5)});
  ASSERT_TRUE(robot().judged(1));
  expectTrue(robot().closures[0], 5, 5);
  EXPECT_EQ(robot().closures[0].a.session, earlier);
  EXPECT_FALSE(robot().closures[0].odometry_gate) << "no odometry between sessions";
}

}  // namespace
}  // namespace loop_metric::test

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "loop_metric_nodelet_test");
  ros::NodeHandle keeps_ros_alive;
  return RUN_ALL_TESTS();
}
