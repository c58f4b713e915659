// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <nodelet/loader.h>
#include <unistd.h>
#include <urban_nav_msgs/LocalizationState.h>

#include <cstdlib>
#include <filesystem>

#include "urban_nav_registration/session/stored_keyframe.hpp"
#include "urban_nav_ros/laser_scan.hpp"
#include "urban_nav_ros/testing/scanning_robot.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav_localization::test {

using namespace urban_nav_ros::testing;
namespace {

using urban_nav_msgs::LocalizationState;
using urban_nav_registration::Keyframe;
using urban_nav_registration::kKeyframeCamera;
using urban_nav_registration::toStoredKeyframe;
using urban_nav_store::Store;

constexpr int kHalf = static_cast<int>(2.0 * kHalfWay / (kSpeed * kPeriod));  // frames of each way

class VisitingRobot : public DrivingRobot {
 public:
  VisitingRobot() : DrivingRobot("localization", room()) {}
};
using Scanning = ScanningRobot<VisitingRobot>;

class ScanningVisitor : public Scanning {
 public:
  ScanningVisitor() { keep("localization/state", states); }
  std::vector<LocalizationState> states;
};

/// Writes a map of the outward drive with laser scans, without keyframes that could be recognised.
void makeMap(const std::string& path) {
  Store store(path, urban_nav_store::Access::Write);
  const urban_nav_store::Session session{
      urban_nav_store::makeSessionId({"lisa", "", kStart, ""}), "first", "lisa", "", kStart, true};
  store.sessions().put(session);
  Keyframe nothing;
  nothing.at.stamp = Scanning::toStamp(0);
  nothing.width = nothing.height = 1;
  store.keyframes().put(session.id, kKeyframeCamera, toStoredKeyframe(nothing));
  for (const auto& [frame, T_base_laser] : Scanning::lasers())
    store.sessions().put(session.id, urban_nav_store::Extrinsic{frame, T_base_laser});
  for (int i = 0; i < kHalf; ++i) {
    urban_nav_store::Node node{Scanning::toStamp(i), Scanning::T_world_base(0).inverse() * Scanning::T_world_base(i)};
    if (i > 0) node.covariance = 1e-7 * urban_nav_core::Matrix6d::Identity();
    store.graph().put(session.id, node);
    for (const auto& [frame, T_base_laser] : Scanning::lasers())
      store.scans().put(session.id, frame,
                        urban_nav_core::toScan(*urban_nav_ros::toPlanarScan(Scanning::scanAt(i, frame, T_base_laser))));
  }
  store.commit();
}

TEST(LocalizationNodeletScans, TheOppositeDirectionIsFoundByLasers) {
  const std::string path =
      (std::filesystem::temp_directory_path() / ("localise_scans_" + std::to_string(::getpid()) + ".db")).string();
  makeMap(path);
  ros::param::set("localization/store", path);
  nodelet::Loader loader(false);
  ASSERT_TRUE(loader.load("/localization", "urban_nav_localization/LocalizationNodelet", {}, {}));
  ScanningVisitor robot;
  ASSERT_TRUE(robot.scanning());
  const auto count = [&](const char* key) { return std::atoi(robot.diagnosis(key).c_str()); };
  // Piece by piece, with a look each: the first where six metres were driven, then each two.
  const auto is_known = [&] { return robot.diagnosis("state") == "LOCALIZED"; };
  int last = kFrames - kHalf;
  for (int to = last + 65; to < kFrames && !is_known(); to += 22) {
    const int scans = count("scans"), queries = count("cloud queries");
    robot.scan(last, to);
    ASSERT_TRUE(DrivingRobot::until([&] { return count("scans") >= scans + 2 * (to - last); }))
        << robot.diagnosis("scans");
    robot.drive(last, to);
    ASSERT_TRUE(DrivingRobot::until([&] { return count("cloud queries") > queries || is_known(); })) << last;
    last = to;
  }
  ASSERT_TRUE(DrivingRobot::until(is_known)) << robot.diagnosis("why") << " after " << count("cloud matches")
                                             << " sightings in " << count("cloud queries") << " looks";
  EXPECT_GE(count("cloud matches"), 2);
  EXPECT_EQ(robot.diagnosis("lasers"), "ok");
  robot.drive(last, last + 1);
  ASSERT_TRUE(DrivingRobot::until([&] {
    return !robot.states.empty() &&
           robot.states.back().header.stamp == urban_nav_ros::toRosTime(Scanning::toStamp(last));
  }));
  const LocalizationState& state = robot.states.back();
  ASSERT_EQ(state.state, LocalizationState::LOCALIZED) << state.message;
  const Pose truth = Scanning::T_world_base(0).inverse() * Scanning::T_world_base(last);
  const auto T_map_base = urban_nav_ros::toPose(state.T_map_base.pose);
  ASSERT_TRUE(T_map_base);
  EXPECT_LT(urban_nav_core::distanceBetween(*T_map_base, truth), 0.1);
  EXPECT_LT(urban_nav_core::angleBetween(*T_map_base, truth), 0.02);
  ros::param::del("localization/store");
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace urban_nav_localization::test
