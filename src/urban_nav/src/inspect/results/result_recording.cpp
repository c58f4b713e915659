// SPDX-License-Identifier: BSD-3-Clause
#include "inspect/results/result_recording.hpp"

#include <diagnostic_msgs/DiagnosticArray.h>

#include <algorithm>
#include <map>

#include "convert/bag_writer.hpp"
#include "inspect/numbered_path.hpp"
#include "inspect/results/closure_topics.hpp"
#include "inspect/results/place_topics.hpp"
#include "inspect/results/pose_topics.hpp"
#include "laser_mapper/map_files.hpp"
#include "topics/lasers/map_export.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_ros/point_cloud.hpp"
#include "urban_nav_ros/stamp.hpp"
#include "urban_nav_ros/topics.hpp"

namespace urban_nav {

using laser_mapper::MapPoint;
using urban_nav_core::StampNs;
using urban_nav_store::Store;
using urban_nav_store::StoredTrajectory;

namespace topics = urban_nav_ros::topics;

namespace {

constexpr double kImageShare = 0.1;  // memory for decoded images

/// Writes each tile at the time of its newest point.
void writeTiles(Store& store, const RecordedMap& map, double memory_mb, BagWriter& recording) {
  std::string bytes;
  forEachMapTile(store, map.sessions(), kImageShare * memory_mb, [&](const std::vector<MapPoint>& points) {
    if (points.empty()) return;
    bytes.clear();
    StampNs newest = map.first();
    for (const MapPoint& point : points) {
      laser_mapper::appendPcdPoint(bytes, point);
      newest = std::max(newest, std::min(point.stamp, map.last()));
    }
    sensor_msgs::PointCloud2 cloud = urban_nav_ros::toPointCloudMessage(laser_mapper::mapPcdFields(), bytes);
    cloud.header.frame_id = map.frame();
    cloud.header.stamp = urban_nav_ros::toRosTime(newest);
    recording.write(topics::results::kPoints, newest, cloud);
  });
}

/// Returns the number of odometry poses by health for each session.
std::vector<StageFigures> storedFigures(Store& store, const RecordedMap& map) {
  std::vector<StageFigures> figures;
  for (const StoredTrajectory& session : map.sessions()) {
    std::map<urban_nav_core::Health, std::size_t> counts;
    store.graph().forEachNode(session.session.id, [&](const urban_nav_store::Node& node) { ++counts[node.status]; });
    StageFigures odometry{"odometry of " + session.session.name, {}, {}};
    for (const auto& [health, count] : counts) {
      odometry.values.emplace_back(urban_nav_core::toString(health), std::to_string(count));
      if (health == urban_nav_core::Health::Lost)
        odometry.warnings.push_back(std::to_string(count) + (count == 1 ? " pose is LOST" : " poses are LOST"));
    }
    figures.push_back(std::move(odometry));
  }
  return figures;
}

void writeDiagnostics(const std::vector<StageFigures>& figures, StampNs stamp, BagWriter& recording) {
  diagnostic_msgs::DiagnosticArray array;
  array.header.stamp = urban_nav_ros::toRosTime(stamp);
  for (const StageFigures& stage : figures) {
    diagnostic_msgs::DiagnosticStatus status;
    status.name = stage.stage;
    status.level =
        stage.warnings.empty() ? diagnostic_msgs::DiagnosticStatus::OK : diagnostic_msgs::DiagnosticStatus::WARN;
    for (const std::string& warning : stage.warnings) status.message += (status.message.empty() ? "" : "; ") + warning;
    for (const auto& [key, value] : stage.values) {
      diagnostic_msgs::KeyValue pair;
      pair.key = key;
      pair.value = value;
      status.values.push_back(pair);
    }
    array.status.push_back(status);
  }
  recording.write(topics::results::kDiagnostics, stamp, array);
}

}  // namespace

std::vector<std::string> recordResults(Store& store, const std::vector<std::vector<StoredTrajectory>>& maps,
                                       const std::string& path, double memory_mb,
                                       const std::vector<StageFigures>& figures) {
  checkResultPath(path);
  std::vector<std::string> files;
  for (const std::vector<StoredTrajectory>& each : maps) {
    const RecordedMap map(each);
    if (map.empty()) continue;
    files.push_back(numberedPath(path, files.size()));
    BagWriter recording(files.back());
    writePoseTopics(store, map, recording);
    writeClosureTopics(store, map, recording);
    writePlaceTopics(store, map, recording);
    writeTiles(store, map, memory_mb, recording);
    writeDiagnostics(figures.empty() ? storedFigures(store, map) : figures, map.last(), recording);
    recording.commit();
  }
  if (files.empty()) throw urban_nav_core::DataError(store.path(), "holds no poses", "");
  return files;
}

std::vector<std::string> recordAllResults(Store& store, const std::string& path, double memory_mb,
                                          const std::vector<StageFigures>& figures) {
  return recordResults(store, urban_nav_store::readMaps(store, urban_nav_store::selectSessions(store, {})), path,
                       memory_mb, figures);
}

}  // namespace urban_nav
