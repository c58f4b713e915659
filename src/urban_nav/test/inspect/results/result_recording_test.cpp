// SPDX-License-Identifier: BSD-3-Clause
#include "inspect/results/result_recording.hpp"

#include <diagnostic_msgs/DiagnosticArray.h>
#include <geometry_msgs/PoseStamped.h>
#include <gtest/gtest.h>
#include <nav_msgs/Path.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/point_cloud2_iterator.h>
#include <tf2_msgs/TFMessage.h>
#include <urban_nav_msgs/MetricClosure.h>
#include <urban_nav_msgs/StageStatus.h>
#include <visualization_msgs/MarkerArray.h>

#include <cmath>

#include "commands/stages.hpp"
#include "inspect/inspect.hpp"
#include "laser_mapper/laser_map.hpp"
#include "map/map_command.hpp"
#include "topics/lasers/map_export.hpp"
#include "urban_nav_core/io/cloud/cloud_file.hpp"
#include "urban_nav_core/io/covariance_csv.hpp"
#include "urban_nav_core/io/tum.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_input/recording/recording.hpp"
#include "urban_nav_input/testing/folders.hpp"
#include "urban_nav_ros/pose.hpp"
#include "urban_nav_ros/stamp.hpp"
#include "urban_nav_ros/topics.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/stored_place.hpp"

namespace urban_nav {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::Vector3d;
using urban_nav_input::RecordedMessage;
using urban_nav_input::Recording;
using urban_nav_input::testing::TemporaryFolder;
using urban_nav_ros::toStampNs;

namespace topics = urban_nav_ros::topics::results;

/// Returns the messages of a topic with their receipts.
template <typename Message>
std::vector<std::pair<StampNs, boost::shared_ptr<Message>>> readTopic(const std::string& path,
                                                                      const std::string& topic) {
  Recording recording(path);
  std::vector<std::pair<StampNs, boost::shared_ptr<Message>>> all;
  auto messages = recording.messages({topic});
  while (const std::optional<RecordedMessage> each = messages.next())
    all.emplace_back(each->receipt(), each->as<Message>());
  return all;
}

/// Returns receipts and bytes of all messages by topic.
std::map<std::string, std::vector<std::pair<StampNs, std::string>>> readBytes(const std::string& path) {
  Recording recording(path);
  std::map<std::string, std::vector<std::pair<StampNs, std::string>>> all;
  auto messages = recording.select(std::nullopt);
  while (const std::optional<RecordedMessage> each = messages.next()) {
    const urban_nav_input::ByteView bytes = each->bytes();
    all[each->topic()].emplace_back(each->receipt(), std::string(bytes.data, bytes.data + bytes.size));
  }
  return all;
}

int callMapOrExport(const std::vector<std::string>& words) {
  std::vector<const char*> argv = {"urban_nav"};
  for (const std::string& word : words) argv.push_back(word.c_str());
  return runCommandLine({mapCommand(makeStages, recordAllResults), exportCommand()}, addStageTables,
                        static_cast<int>(argv.size()), argv.data());
}

void expectPoses(const std::string& path, const urban_nav_core::Trajectory& trajectory, const std::string& frame) {
  const auto odometry = readTopic<nav_msgs::Odometry>(path, topics::kOdometry);
  ASSERT_EQ(odometry.size(), trajectory.size());
  for (std::size_t i = 0; i < odometry.size(); ++i) {
    const nav_msgs::Odometry& message = *odometry[i].second;
    EXPECT_EQ(odometry[i].first, trajectory[i].stamp);
    EXPECT_EQ(toStampNs(message.header.stamp), trajectory[i].stamp);
    EXPECT_EQ(message.header.frame_id, frame);
    EXPECT_EQ(message.child_frame_id, "base_link");
    EXPECT_TRUE(isApprox(*urban_nav_ros::toPose(message.pose.pose), trajectory[i].pose, 1e-12)) << i;
  }
  const auto transforms = readTopic<tf2_msgs::TFMessage>(path, "/tf");
  ASSERT_EQ(transforms.size(), trajectory.size());
  for (std::size_t i = 0; i < transforms.size(); ++i) {
    Pose T_frame_base;
    std::string parent = frame;
    for (const geometry_msgs::TransformStamped& each : transforms[i].second->transforms) {
      EXPECT_EQ(each.header.frame_id, parent);
      EXPECT_EQ(toStampNs(each.header.stamp), trajectory[i].stamp);
      T_frame_base = T_frame_base * *urban_nav_ros::toPose(each.transform);
      parent = each.child_frame_id;
    }
    EXPECT_EQ(parent, "base_link");
    EXPECT_TRUE(isApprox(T_frame_base, trajectory[i].pose, 1e-9)) << i;
  }
  const auto paths = readTopic<nav_msgs::Path>(path, topics::kPath);
  ASSERT_EQ(paths.size(), 1U);
  ASSERT_EQ(paths[0].second->poses.size(), trajectory.size());
  EXPECT_EQ(paths[0].second->header.frame_id, frame);
  for (std::size_t i = 0; i < trajectory.size(); ++i)
    EXPECT_TRUE(isApprox(*urban_nav_ros::toPose(paths[0].second->poses[i].pose), trajectory[i].pose, 1e-12));
}

TEST(MapMcap, HoldsTheTrajectoryAndExportWritesTheSame) {
  const TemporaryFolder folder;
  urban_nav_input::testing::KittiStyle style;
  style.frames = 12;
  urban_nav_input::testing::makeKittiFolder(folder.file("in"), style);
  const std::string mapped = folder.file("run.mcap"), exported = folder.file("export.mcap");
  ASSERT_EQ(
      callMapOrExport({"map", folder.file("in"), "--out", folder.file("out"), "--stages", "vo", "--mcap", mapped}), 0);
  expectPoses(mapped, urban_nav_core::readTum(folder.file("out/trajectory.tum")), "odom");
  const auto poses = readTopic<nav_msgs::Odometry>(mapped, topics::kOdometry);
  const std::vector<urban_nav_core::CovarianceRow> rows =
      urban_nav_core::readCovariances(folder.file("out/covariance.csv"));
  ASSERT_EQ(poses.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i)  // without a graph, odom has the axes of the first pose
    for (std::size_t k = 0; k < 36; ++k)
      EXPECT_NEAR(poses[i].second->pose.covariance[k], rows[i].covariance(k / 6, k % 6), 1e-12);
  EXPECT_GT(poses.back().second->pose.covariance[0], 0.0);
  EXPECT_TRUE(Recording(mapped).warnings().empty());
  for (const urban_nav_input::Connection& connection : Recording(mapped).connections()) {
    EXPECT_EQ(connection.encoding, "cdr") << connection.topic;
    EXPECT_EQ(connection.definition_encoding, "ros2msg") << connection.topic;
    EXPECT_EQ(Recording(mapped).undecoded(connection.topic), "") << connection.topic;
  }
  ASSERT_EQ(callMapOrExport({"export", folder.file("out/session.db"), "--mcap", exported}), 0);
  auto of_map = readBytes(mapped);
  EXPECT_EQ(of_map.count(topics::kDiagnostics), 1U);
  auto of_export = readBytes(exported);
  EXPECT_EQ(of_export.erase(topics::kDiagnostics), 1U) << "others";
  of_map.erase(topics::kDiagnostics);
  EXPECT_TRUE(of_map == of_export);

  const auto diagnostics = readTopic<diagnostic_msgs::DiagnosticArray>(mapped, topics::kDiagnostics);
  ASSERT_EQ(diagnostics.size(), 1U);
  ASSERT_FALSE(diagnostics[0].second->status.empty());
  EXPECT_EQ(diagnostics[0].second->status[0].name, "swf_vo");
  EXPECT_FALSE(diagnostics[0].second->status[0].values.empty());
  EXPECT_EQ(diagnostics[0].first, readTopic<nav_msgs::Odometry>(mapped, topics::kOdometry).back().first);
  const auto mounted = readTopic<tf2_msgs::TFMessage>(mapped, "/tf_static");
  ASSERT_EQ(mounted.size(), 1U);
  EXPECT_EQ(mounted[0].second->transforms.at(0).header.frame_id, "base_link");
  const auto status = readTopic<urban_nav_msgs::StageStatus>(mapped, topics::kStatus);
  ASSERT_FALSE(status.empty());
  EXPECT_EQ(status[0].second->stage, "swf_vo");
}

TEST(MapMcap, RefusesOtherNames) {
  const TemporaryFolder folder;
  EXPECT_EQ(callMapOrExport({"map", folder.file("in"), "--out", folder.file("out"), "--mcap", folder.file("run.bag")}),
            2);
  EXPECT_EQ(callMapOrExport({"export", folder.file("session.db"), "--mcap", folder.file("run.bag")}), 2);
}

constexpr StampNs kStart = 1'225'719'872'000'000'000;
constexpr StampNs kPeriod = 50'000'000;
constexpr const char* kWall = "0123456789abcdef0123";

/// A store of a relaxed drive of 8 m along x along a wall at y = 4, with closures and places.
class ResultRecording : public ::testing::Test {
 protected:
  ResultRecording() : store_(folder_.file("session.db"), urban_nav_store::Access::Write) {
    store_.sessions().put(urban_nav_store::Session{kWall, "wall", "", "", 1, true});
    Eigen::Matrix3d R;
    R << 0, 0, 1, 1, 0, 0, 0, 1, 0;
    store_.sessions().put(
        kWall, urban_nav_store::Extrinsic{urban_nav_core::frames::kLaserLeft, Pose(R, Vector3d(0.0, 0.0, 1.0))});
    for (int i = 0; i <= 160; ++i) {
      urban_nav_store::Node node;
      node.stamp = kStart + i * kPeriod;
      node.T_odom_base = at(0.049 * i);
      node.status = i == 50 ? urban_nav_core::Health::Degraded : urban_nav_core::Health::Ok;
      store_.graph().put(kWall, node);
      store_.graph().put(kWall, urban_nav_store::RelaxedPose{node.stamp, at(0.05 * i), 1});
      if (i > 0 && i < 160) store_.scans().put(kWall, urban_nav_core::frames::kLaserLeft, scan(node.stamp));
    }
    putClosures();
    urban_nav_store::StoredPlace place;
    place.session = kWall;
    place.stamp = kStart + 10 * kPeriod + kPeriod / 2;
    place.status = "used";
    place.thumbnail = "JPEG";
    urban_nav_store::TableStore<urban_nav_store::StoredPlace>(store_).put(place);
    store_.commit();
    const auto maps = readMaps();
    const urban_nav_core::Trajectory trajectory(maps.front().front().T_map_base);
    laser_mapper::LaserMap(laser_mapper::Parameters(), store_, {{kWall, &trajectory, nullptr}}).render();
  }

  static Pose at(double x) { return Pose(urban_nav_core::Quaterniond::Identity(), Vector3d(x, 0.0, 0.0)); }
  static urban_nav_core::Scan scan(StampNs stamp) {
    urban_nav_core::Scan scan;
    scan.stamp = stamp;
    for (int degrees = -10; degrees <= 40; ++degrees) {
      const double angle = degrees * M_PI / 180.0;
      urban_nav_core::Beam beam;
      beam.stamp = stamp;
      beam.direction = Vector3d(std::cos(angle), std::sin(angle), 0.0).cast<float>();
      beam.range = static_cast<float>(4.0 / std::cos(angle));
      scan.beams.push_back(beam);
    }
    return scan;
  }
  void putClosures() {
    urban_nav_store::Edge edge;
    edge.a = {kWall, kStart};
    edge.b = {kWall, kStart + 100 * kPeriod};
    edge.kind = urban_nav_store::EdgeKind::Stereo;
    edge.source = "loop_metric";
    edge.measured = {at(5.0), urban_nav_core::Matrix6d::Identity()};
    store_.graph().put(edge);
    edge.b.stamp += kPeriod;
    edge.verdict = urban_nav_core::ClosureVerdict::Rejected;
    edge.reason = "not the same place";
    store_.graph().put(edge);
  }
  std::vector<std::vector<urban_nav_store::StoredTrajectory>> readMaps() {
    return urban_nav_store::readMaps(store_, urban_nav_store::selectSessions(store_, {}));
  }

  TemporaryFolder folder_;
  urban_nav_store::Store store_;
};

TEST_F(ResultRecording, PosesOfARelaxedSessionAreInTheMap) {
  const std::string path = folder_.file("a.mcap");
  EXPECT_EQ(recordResults(store_, readMaps(), path, 100.0, {}), std::vector<std::string>{path});
  expectPoses(path, urban_nav_core::Trajectory(readMaps()[0][0].T_map_base), "map");
  const auto odometry = readTopic<nav_msgs::Odometry>(path, topics::kOdometry);
  EXPECT_NEAR(odometry[5].second->twist.twist.linear.x, 0.98, 1e-9) << "0.049 m in 0.05 s";
  const auto status = readTopic<urban_nav_msgs::StageStatus>(path, topics::kStatus);
  ASSERT_EQ(status.size(), 3U) << "at the first pose, and where it changes";
  EXPECT_EQ(status[1].first, kStart + 50 * kPeriod);
  EXPECT_EQ(status[1].second->status, urban_nav_msgs::StageStatus::DEGRADED);
  const auto diagnostics = readTopic<diagnostic_msgs::DiagnosticArray>(path, topics::kDiagnostics);
  ASSERT_EQ(diagnostics.size(), 1U);
  EXPECT_EQ(diagnostics[0].second->status.at(0).values.at(1).key, "DEGRADED");
  EXPECT_EQ(diagnostics[0].second->status.at(0).values.at(1).value, "1");
}

TEST_F(ResultRecording, TilesHoldThePointsOfTheMap) {
  const std::string path = folder_.file("a.mcap"), ply = folder_.file("map.ply");
  recordResults(store_, readMaps(), path, 100.0, {});
  exportMap(store_, readMaps().front(), {ply, "", "", "", ""}, 100.0);
  const auto expected = urban_nav_core::readCloud(ply).cloud.points;
  std::size_t i = 0;
  auto tiles = readTopic<sensor_msgs::PointCloud2>(path, topics::kPoints);
  ASSERT_GT(tiles.size(), 0U);
  std::vector<Eigen::Vector3f> points;
  for (const auto& [receipt, cloud] : tiles) {
    EXPECT_EQ(cloud->header.frame_id, "map");
    EXPECT_EQ(toStampNs(cloud->header.stamp), receipt);
    EXPECT_GE(receipt, kStart);
    EXPECT_LE(receipt, kStart + 160 * kPeriod);
    for (sensor_msgs::PointCloud2ConstIterator<float> p(*cloud, "x"); p != p.end(); ++p)
      points.emplace_back(p[0], p[1], p[2]);
  }
  ASSERT_EQ(points.size(), expected.size());
  const auto less = [](const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
  };
  auto sorted = expected;
  std::sort(sorted.begin(), sorted.end(), less);
  std::sort(points.begin(), points.end(), less);
  for (const Eigen::Vector3f& point : sorted) ASSERT_EQ(points[i++], point);
}

TEST_F(ResultRecording, ClosuresAndPlacesAreAtTheirStamps) {
  const std::string path = folder_.file("a.mcap");
  recordResults(store_, readMaps(), path, 100.0, {});
  const auto closures = readTopic<urban_nav_msgs::MetricClosure>(path, topics::kClosures);
  ASSERT_EQ(closures.size(), 2U);
  EXPECT_EQ(closures[0].first, kStart + 100 * kPeriod);
  EXPECT_EQ(closures[0].second->verdict, urban_nav_msgs::MetricClosure::ACCEPTED);
  EXPECT_EQ(closures[0].second->T_a_b.position.x, 5.0);
  EXPECT_EQ(closures[1].second->verdict, urban_nav_msgs::MetricClosure::REJECTED);
  EXPECT_EQ(closures[1].second->message, "not the same place");
  const auto markers = readTopic<visualization_msgs::MarkerArray>(path, topics::kClosureMarkers);
  ASSERT_EQ(markers.size(), 1U);
  const auto places = readTopic<geometry_msgs::PoseStamped>(path, topics::kPlaces);
  ASSERT_EQ(places.size(), 1U);
  EXPECT_EQ(places[0].first, kStart + 10 * kPeriod + kPeriod / 2);
  EXPECT_NEAR(places[0].second->pose.position.x, 0.525, 1e-9);
  const auto images = readTopic<sensor_msgs::CompressedImage>(path, topics::kPlaceImages);
  ASSERT_EQ(images.size(), 1U);
  EXPECT_EQ(std::string(images[0].second->data.begin(), images[0].second->data.end()), "JPEG");
}

TEST_F(ResultRecording, AStoreWithoutPosesIsRefused) {
  urban_nav_store::Store empty(folder_.file("empty.db"), urban_nav_store::Access::Write);
  empty.sessions().put(urban_nav_store::Session{kWall, "wall", "", "", 1, true});
  EXPECT_THROW(recordAllResults(empty, folder_.file("b.mcap"), 100.0, {}), urban_nav_core::DataError);
}

}  // namespace
}  // namespace urban_nav
