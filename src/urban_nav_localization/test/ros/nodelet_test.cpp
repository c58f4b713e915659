// SPDX-License-Identifier: BSD-3-Clause
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <gtest/gtest.h>
#include <nav_msgs/Path.h>
#include <nodelet/loader.h>
#include <rosgraph_msgs/Log.h>
#include <unistd.h>
#include <urban_nav_msgs/LocalizationState.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>

#include "urban_nav_registration/keyframe/keyframe_extractor.hpp"
#include "urban_nav_registration/keyframe/keyframe_selector.hpp"
#include "urban_nav_registration/session/calibration_fingerprint.hpp"
#include "urban_nav_registration/session/stored_keyframe.hpp"
#include "urban_nav_ros/testing/driving_robot.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav_localization::test {

using namespace urban_nav_ros::testing;
namespace {

using geometry_msgs::PoseWithCovarianceStamped;
using urban_nav_msgs::LocalizationState;
using urban_nav_registration::calibrationFingerprint;
using urban_nav_registration::kCalibrationProperty;
using urban_nav_registration::KeyframeExtractor;
using urban_nav_registration::KeyframeSelector;
using urban_nav_registration::kKeyframeCamera;
using urban_nav_registration::toStoredKeyframe;
using urban_nav_store::Access;
using urban_nav_store::Store;

std::string toBytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream bytes;
  bytes << file.rdbuf();
  return bytes.str();
}

/// Robot on a second day that subscribes to the topics of localization.
class Visitor : public DrivingRobot {
 public:
  explicit Visitor(urban_nav_core::testing::RenderedSequence sequence)
      : DrivingRobot("localization", std::move(sequence)) {
    keep("localization/state", states);
    keep("localization/pose", poses);
    keep("localization/map_path", maps);
    keep("/tf", transforms);
    beliefs_ = advertise<PoseWithCovarianceStamped>("initialpose");
  }
  void applyInitialPose(const Pose& T_map_base, const std::string& frame = "map") {
    PoseWithCovarianceStamped message;
    message.header.frame_id = frame;
    message.pose.pose = urban_nav_ros::toPoseMessage(T_map_base);
    message.pose.covariance[0] = message.pose.covariance[7] = 0.25;  // as rviz has it
    message.pose.covariance[35] = 0.07;
    beliefs_.publish(message);
  }
  bool becomes(std::uint8_t state) {
    return until([&] { return !states.empty() && states.back().state == state; });
  }
  bool settledAt(int frame) {
    return until(
        [&] { return !states.empty() && states.back().header.stamp == urban_nav_ros::toRosTime(toStamp(frame)); });
  }
  /// The first state at the end of the step that leads to this frame: before any query of the frame is answered.
  const LocalizationState& firstAt(int frame) const {
    return *std::find_if(states.begin(), states.end(), [&](const LocalizationState& each) {
      return each.header.stamp == urban_nav_ros::toRosTime(toStamp(frame));
    });
  }
  bool hasSaid(std::uint8_t state) const {
    return std::any_of(states.begin(), states.end(),
                       [&](const LocalizationState& each) { return each.state == state; });
  }
  std::optional<Pose> T_map_odom() const {
    std::optional<Pose> found;
    for (const tf2_msgs::TFMessage& message : transforms)
      for (const auto& each : message.transforms)
        if (each.header.frame_id == "map" && each.child_frame_id == "odom")
          found = urban_nav_ros::toPose(each.transform);
    return found;
  }

  std::vector<LocalizationState> states;
  std::vector<PoseWithCovarianceStamped> poses;
  std::vector<nav_msgs::Path> maps;
  std::vector<tf2_msgs::TFMessage> transforms;

 private:
  ros::Publisher beliefs_;
};

class LocalizationNodelet : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::filesystem::temp_directory_path() / ("localise_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
    makeMap(path("map.db"));
  }
  static void TearDownTestSuite() { std::filesystem::remove_all(folder_); }
  void SetUp() override { bytes_ = toBytes(path("map.db")); }
  void TearDown() override {
    loader_.clear();
    EXPECT_EQ(toBytes(path("map.db")), bytes_) << "the map stays as it is";
  }

  static std::string path(const std::string& name) { return (folder_ / name).string(); }
  /// The first day: once around the room.
  static void makeMap(const std::string& path) {
    auto day = room();
    const urban_nav_core::StereoCamera camera = makeCamera(day.options().camera);
    const KeyframeExtractor extractor(camera, urban_nav_registration::Parameters().points);
    KeyframeSelector selector((urban_nav_registration::Parameters()));
    Store store(path, Access::Write);
    const urban_nav_store::Session session{
        urban_nav_store::makeSessionId({"lisa", "", kStart, ""}), "first", "lisa", "", kStart, true};
    store.sessions().put(session);
    store.sessions().put(
        session.id, urban_nav_store::Property{kCalibrationProperty, calibrationFingerprint(camera, T_base_left())});
    for (int i = 0; i < kLap; ++i) {
      const Pose T_map_base = T_map_world() * day.T_world_camera(i) * T_base_left().inverse();
      store.graph().put(session.id, urban_nav_store::Node{day.stamp(i), T_map_base});
      if (selector.select(T_map_base))
        store.keyframes().put(session.id, kKeyframeCamera,
                              toStoredKeyframe(extractor.extract({"", day.stamp(i)}, day.frame(i).pair())));
    }
    store.commit();
  }
  static Pose T_map_world() { return (room().T_world_camera(0) * T_base_left().inverse()).inverse(); }

  /// With this store; false where it does not start.
  bool load(const std::string& store) {
    ros::param::set("localization/store", store);
    try {
      return loader_.load("/localization", "urban_nav_localization/LocalizationNodelet", {}, {});
    } catch (const std::exception&) {
      return false;
    }
  }
  static void expectRight(const Visitor& robot, int frame) {
    const LocalizationState& state = robot.states.back();
    EXPECT_EQ(state.state, LocalizationState::LOCALIZED) << state.message;
    const auto T_map_base = urban_nav_ros::toPose(state.T_map_base.pose);
    ASSERT_TRUE(T_map_base && state.has_pose);
    const Pose truth = T_map_world() * robot.T_world_base(frame);
    EXPECT_LT(urban_nav_core::distanceBetween(*T_map_base, truth), 0.1);
    EXPECT_LT(urban_nav_core::angleBetween(*T_map_base, truth), 0.02);
    EXPECT_EQ(state.header.frame_id, "map");
    EXPECT_EQ(state.reason_name, "None");
    EXPECT_GE(state.supporting_matches, 2U);
    EXPECT_GT(state.probability, 0.99);
    EXPECT_GT(urban_nav_ros::toMatrix6(state.T_map_base.covariance).diagonal().minCoeff(), 0.0);
    EXPECT_LT(std::sqrt(state.T_map_base.covariance[0]), 0.33);
  }

  static std::filesystem::path folder_;
  nodelet::Loader loader_{false};
  std::string bytes_;
};
std::filesystem::path LocalizationNodelet::folder_;

TEST_F(LocalizationNodelet, AnotherDayIsKnownWhereItIs) {
  ASSERT_TRUE(load(path("map.db")));
  Visitor robot(roomOfAnotherDay());
  ASSERT_TRUE(DrivingRobot::until([&] { return robot.isConnected() && !robot.states.empty() && !robot.maps.empty(); }));
  EXPECT_EQ(robot.states[0].state, LocalizationState::UNCERTAIN) << "before the first frame";
  EXPECT_EQ(robot.states[0].reason_name, "NoMatch");
  EXPECT_FALSE(robot.states[0].has_pose);
  EXPECT_EQ(robot.maps[0].header.frame_id, "map");
  EXPECT_GT(robot.maps[0].poses.size(), 8U);
  EXPECT_EQ(robot.maps[0].poses[0].pose.position.x, 0.0);
  EXPECT_FALSE(robot.T_map_odom());
  robot.drive(0, 9);
  ASSERT_TRUE(robot.becomes(LocalizationState::LOCALIZED)) << robot.states.back().message;
  robot.drive(9, 14);
  ASSERT_TRUE(robot.settledAt(13));
  expectRight(robot, 13);
  ASSERT_TRUE(DrivingRobot::until([&] { return robot.T_map_odom() && !robot.poses.empty(); }));
  const Pose T_odom_base = robot.T_world_base(0).inverse() * robot.T_world_base(13);
  EXPECT_LT(urban_nav_core::distanceBetween(*robot.T_map_odom() * T_odom_base, T_map_world() * robot.T_world_base(13)),
            0.1);
  EXPECT_EQ(robot.poses.back().header.frame_id, "map");
  EXPECT_TRUE(DrivingRobot::until([&] { return robot.diagnosed("state", "LOCALIZED"); }));

  std_srvs::Trigger trigger;
  ASSERT_TRUE(ros::service::call("localization/reset", trigger) && trigger.response.success);
  ASSERT_TRUE(robot.becomes(LocalizationState::UNCERTAIN)) << "before the next step";
  robot.drive(14, 15);
  ASSERT_TRUE(robot.settledAt(14));
  EXPECT_EQ(robot.states.back().state, LocalizationState::UNCERTAIN) << "whoever is moved by hand says so";
}

TEST_F(LocalizationNodelet, AnInitialPoseIsNeitherNeededNorAcceptedAgainstMatches) {
  ASSERT_TRUE(load(path("map.db")));
  Visitor robot(roomOfAnotherDay());
  ASSERT_TRUE(DrivingRobot::until([&] { return robot.isConnected(); }));
  const Pose wrong = T_map_world() * robot.T_world_base(kLap / 2);
  robot.applyInitialPose(wrong, "odom");
  ASSERT_TRUE(DrivingRobot::until([&] { return robot.diagnosed("initial poses rejected", "1"); }));
  robot.applyInitialPose(wrong);
  ASSERT_TRUE(DrivingRobot::until([&] { return robot.diagnosed("initial poses taken", "1"); }));
  robot.drive(0, 2, false);
  ASSERT_TRUE(robot.settledAt(1));
  EXPECT_EQ(robot.states.back().state, LocalizationState::UNCERTAIN);
  EXPECT_EQ(robot.states.back().reason_name, "InitialPoseOnly");
  ASSERT_TRUE(robot.states.back().has_pose) << "the best guess there is";
  EXPECT_LT(robot.states.back().probability, 0.5);
  EXPECT_FALSE(robot.T_map_odom());
  robot.drive(2, 11);
  ASSERT_TRUE(robot.becomes(LocalizationState::LOCALIZED)) << robot.states.back().message;
  robot.applyInitialPose(wrong);
  ASSERT_TRUE(DrivingRobot::until([&] { return robot.diagnosed("initial poses taken", "2"); }));
  robot.drive(11, 15);
  ASSERT_TRUE(robot.settledAt(14));
  expectRight(robot, 14);
}

TEST_F(LocalizationNodelet, AnUnmappedWorldIsNew) {
  ASSERT_TRUE(load(path("map.db")));
  Visitor robot(street());
  ASSERT_TRUE(DrivingRobot::until([&] { return robot.isConnected(); }));
  robot.drive(0, 12);
  ASSERT_TRUE(robot.settledAt(11));
  ASSERT_TRUE(DrivingRobot::until([&] { return robot.diagnosed("why", "NothingSimilar"); }));
  robot.drive(12, 13);
  ASSERT_TRUE(robot.becomes(LocalizationState::UNMAPPED));
  EXPECT_FALSE(robot.hasSaid(LocalizationState::LOCALIZED));
  EXPECT_FALSE(robot.T_map_odom());
  EXPECT_TRUE(robot.poses.empty());
}

TEST_F(LocalizationNodelet, AGapInOdometryIsABeginning) {
  ASSERT_TRUE(load(path("map.db")));
  Visitor robot(roomOfAnotherDay());
  ASSERT_TRUE(DrivingRobot::until([&] { return robot.isConnected(); }));
  robot.drive(0, 9);
  ASSERT_TRUE(robot.becomes(LocalizationState::LOCALIZED)) << robot.states.back().message;
  robot.drive(9, 11, true, 9);
  ASSERT_TRUE(robot.settledAt(10));
  EXPECT_EQ(robot.firstAt(10).state, LocalizationState::UNCERTAIN);
  robot.drive(11, 18);
  ASSERT_TRUE(robot.becomes(LocalizationState::LOCALIZED)) << robot.states.back().message;
  ASSERT_TRUE(robot.settledAt(17));
  expectRight(robot, 17);
}

TEST_F(LocalizationNodelet, AStoreThatIsNoneIsNamedWithTheParameter) {
  std::vector<rosgraph_msgs::Log> logs;
  const boost::function<void(const rosgraph_msgs::LogConstPtr&)> hear = [&](const rosgraph_msgs::LogConstPtr& log) {
    logs.push_back(*log);
  };
  const ros::Subscriber subscriber = ros::NodeHandle().subscribe<rosgraph_msgs::Log>("/rosout", 1000, hear);
  ASSERT_TRUE(DrivingRobot::until([&] { return subscriber.getNumPublishers() > 0; }));
  {
    Store empty(path("empty.db"), Access::Write);
    empty.sessions().put(urban_nav_store::Session{"0123456789abcdef0123", "empty", "", "", kStart, true});
    empty.commit();
  }
  const auto complains = [&](const std::string& store, const std::string& words) {
    EXPECT_FALSE(load(store)) << store;
    EXPECT_TRUE(DrivingRobot::until([&] {
      return std::any_of(logs.begin(), logs.end(), [&](const rosgraph_msgs::Log& log) {
        return log.level == rosgraph_msgs::Log::FATAL && log.msg.find("/localization/store") != std::string::npos &&
               log.msg.find(store) != std::string::npos && log.msg.find(words) != std::string::npos;
      });
    })) << store;
  };
  complains("here.db", "absolute path");
  complains(path("missing.db"), "");
  complains(path("empty.db"), "holds no keyframes");
  std::ofstream(path("text.db")) << "this is no store";
  complains(path("text.db"), "");
}

}  // namespace
}  // namespace urban_nav_localization::test

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "urban_nav_localization_nodelet_test");
  ros::NodeHandle keeps_ros_alive;
  return RUN_ALL_TESTS();
}
