// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <nodelet/loader.h>
#include <unistd.h>
#include <urban_nav_msgs/Localisation.h>

#include <cstdlib>
#include <filesystem>

#include "loop_metric/stored_surroundings.hpp"
#include "scanning.hpp"
#include "urban_nav_ros/laser_scan.hpp"
#include "urban_nav_store/store.hpp"

namespace loop_metric::test {
namespace {

using urban_nav_msgs::Localisation;
using urban_nav_store::Store;

constexpr int half = static_cast<int>(2.0 * half_way / (speed * period));  // frames of each way

class ScanningVisitor : public Scanning {
 public:
  ScanningVisitor() { keep("localisation/state", states); }
  std::vector<Localisation> states;
};

/// The way there, with what the lasers saw; no view that could be recognised.
void makeMap(const std::string& path) {
  Store store(path, urban_nav_store::Access::Write);
  const urban_nav_store::Session session{
      urban_nav_store::sessionIdOf({"lisa", "", start, ""}), "first", "lisa", "", start, true};
  store.sessions().put(session);
  Keyframe nothing;
  nothing.at.stamp = Scanning::stampOf(0);
  nothing.width = nothing.height = 1;
  store.keyframes().put(session.id, keyframe_camera, storedKeyframe(nothing));
  for (const auto& [frame, T_base_laser] : Scanning::lasers())
    store.sessions().put(session.id, urban_nav_store::Extrinsic{frame, T_base_laser});
  for (int i = 0; i < half; ++i) {
    urban_nav_store::Node node{Scanning::stampOf(i), Scanning::T_world_base(0).inverse() * Scanning::T_world_base(i)};
    if (i > 0) node.covariance = 1e-7 * urban_nav_core::Matrix6d::Identity();
    store.graph().put(session.id, node);
    for (const auto& [frame, T_base_laser] : Scanning::lasers())
      store.scans().put(session.id, frame,
                        urban_nav_core::toScan(*urban_nav_ros::toPlanarScan(Scanning::scanAt(i, frame, T_base_laser))));
  }
  store.commit();
}

TEST(LocaliseNodeletScans, whoDrivesTheOtherWayIsFoundByItsLasers) {
  const std::string path =
      (std::filesystem::temp_directory_path() / ("localise_scans_" + std::to_string(::getpid()) + ".db")).string();
  makeMap(path);
  ros::param::set("localisation/store", path);
  nodelet::Loader loader(false);
  ASSERT_TRUE(loader.load("/localisation", "loop_metric/LocaliseNodelet", {}, {}));
  ScanningVisitor robot;
  ASSERT_TRUE(robot.scanning());
  const auto count = [&](const char* key) { return std::atoi(robot.diagnosis(key).c_str()); };
  // Piece by piece, with a look each: the first where six metres were driven, then each two.
  const auto is_known = [&] { return robot.diagnosis("knowledge") == "KNOWN"; };
  int last = frames - half;
  for (int to = last + 65; to < frames && !is_known(); to += 22) {
    const int scans = count("scans"), looks = count("looks at clouds");
    robot.scan(last, to);
    ASSERT_TRUE(Robot::until([&] { return count("scans") >= scans + 2 * (to - last); })) << robot.diagnosis("scans");
    robot.drive(last, to);
    ASSERT_TRUE(Robot::until([&] { return count("looks at clouds") > looks || is_known(); })) << last;
    last = to;
  }
  ASSERT_TRUE(Robot::until(is_known)) << robot.diagnosis("why") << " after " << count("sightings of clouds")
                                      << " sightings in " << count("looks at clouds") << " looks";
  EXPECT_GE(count("sightings of clouds"), 2);
  EXPECT_EQ(robot.diagnosis("lasers"), "ok");
  robot.drive(last, last + 1);
  ASSERT_TRUE(Robot::until([&] {
    return !robot.states.empty() &&
           robot.states.back().header.stamp == urban_nav_ros::toRosTime(Scanning::stampOf(last));
  }));
  const Localisation& state = robot.states.back();
  ASSERT_EQ(state.knowledge, Localisation::KNOWN) << state.text;
  const Pose truth = Scanning::T_world_base(0).inverse() * Scanning::T_world_base(last);
  const auto T_map_base = urban_nav_ros::toPose(state.T_map_base.pose);
  ASSERT_TRUE(T_map_base);
  EXPECT_LT(urban_nav_core::distanceBetween(*T_map_base, truth), 0.1);
  EXPECT_LT(urban_nav_core::angleBetween(*T_map_base, truth), 0.02);
  ros::param::del("localisation/store");
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace loop_metric::test
