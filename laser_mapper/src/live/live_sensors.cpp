// SPDX-License-Identifier: BSD-3-Clause
#include "live/live_sensors.hpp"

#include <algorithm>
#include <utility>

#include "laser_mapper/depth_image_row.hpp"
#include "laser_mapper/map_cell.hpp"
#include "laser_mapper/sensors.hpp"
#include "urban_nav_core/laser/planar_sweep.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/depth_view.hpp"
#include "urban_nav_store/tables/lidar_sweep.hpp"
#include "urban_nav_store/tables/mounted_lidar.hpp"

namespace laser_mapper {

using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::TravelSpacing;
using urban_nav_store::DepthImage;
using urban_nav_store::DepthView;
using urban_nav_store::LidarSweep;
using urban_nav_store::MountedLidar;
using urban_nav_store::TableStore;

bool LiveSensors::hasTiltedLaser() const {
  return std::any_of(lasers_.begin(), lasers_.end(),
                     [](const auto& laser) { return !urban_nav_core::isHorizontal(laser.second); });
}

void LiveSensors::placeLaser(const std::string& frame, const Pose& T_base_laser) {
  if (lasers_.emplace(frame, T_base_laser).second) storePlaces();
}

void LiveSensors::placeLidar(const std::string& frame, const Pose& T_base_lidar) {
  Spaced lidar;
  lidar.role = "points" + std::to_string(lidars_.size());
  lidar.T_base_sensor = T_base_lidar;
  if (lidars_.emplace(frame, lidar).second) storePlaces();
}

void LiveSensors::placeDepthCamera(const std::string& frame, const Pose& T_base_camera) {
  if (depth_cameras_.size() == kMostDepthCameras) return;
  Spaced camera;
  camera.role = depthRole(depth_cameras_.size());
  camera.T_base_sensor = T_base_camera;
  depth_cameras_.emplace(frame, camera);
}

void LiveSensors::begin(urban_nav_store::Store& store) {
  store_ = &store;
  counts_ = {};
  for (auto& each : lidars_) each.second.spacing = TravelSpacing(urban_nav_core::kSweepSpacing);
  for (auto& each : depth_cameras_) each.second.spacing = TravelSpacing(urban_nav_core::kSweepSpacing);
  views_ = TravelSpacing(urban_nav_core::kSweepSpacing);
  storePlaces();
}

void LiveSensors::storePlaces() {
  for (const auto& [frame, T_base_laser] : lasers_)
    store_->sessions().put(session_, urban_nav_store::Extrinsic{frame, T_base_laser});
  for (const auto& [frame, lidar] : lidars_)
    TableStore<MountedLidar>(*store_).put({session_, lidar.role, frame, lidar.T_base_sensor});
}

void LiveSensors::put(const std::string& frame, const urban_nav_core::Scan& scan) {
  store_->scans().put(session_, frame, scan);
  ++counts_.scans;
}

void LiveSensors::put(const std::string& frame, const urban_nav_core::Sweep& sweep, const MaybePose& newest) {
  Spaced& lidar = lidars_.at(frame);
  if (!lidar.spacing.takes(sweep.reference, newest)) return;
  TableStore<LidarSweep>(*store_).put({session_, lidar.role, sweep.reference, LidarSweep::pack(sweep)});
  ++counts_.sweeps;
}

void LiveSensors::put(const std::string& frame, StampNs stamp, const urban_nav_core::Pinhole& pinhole,
                      const DecodeDepth& decode, const MaybePose& newest) {
  Spaced& camera = depth_cameras_.at(frame);
  if (!camera.spacing.takes(stamp, newest)) return;
  const cv::Mat depth = decode();
  if (depth.empty()) {
    ++counts_.invalid_depth;
    return;
  }
  DepthImage row = depthImageRow(depth, pinhole);
  row.session = session_;
  row.role = camera.role;
  row.stamp = stamp;
  row.frame = frame;
  row.T_base_camera = camera.T_base_sensor;
  TableStore<DepthImage>(*store_).put(row);
  ++counts_.depth_images;
}

void LiveSensors::put(StampNs stamp, const urban_nav_core::DepthSamples& view, const Pose& T_base_camera,
                      const MaybePose& newest) {
  if (hasTiltedLaser() || !views_.takes(stamp, newest)) return;
  DepthView row;
  row.session = session_;
  row.stamp = stamp;
  row.step = view.step;
  row.fx = view.fx;
  row.fy = view.fy;
  row.cx = view.cx;
  row.cy = view.cy;
  row.baseline = view.baseline;
  row.T_base_camera = T_base_camera;
  row.packed = DepthView::pack({view.width, view.height, view.disparity, view.sigma, view.grey});
  TableStore<DepthView>(*store_).put(row);
  ++counts_.stereo_views;
}

}  // namespace laser_mapper
