// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>

#include "urban_nav_core/camera/depth_samples.hpp"
#include "urban_nav_core/camera/pinhole.hpp"
#include "urban_nav_core/laser/scan.hpp"
#include "urban_nav_core/laser/sweep.hpp"
#include "urban_nav_core/trajectory/travel_spacing.hpp"
#include "urban_nav_store/store.hpp"

namespace laser_mapper {

/// Sensors of a running session, by frame, with their mounting. Stores their measurements: all scans of planar lasers,
/// and as many sweeps of 3D LiDARs, images of depth cameras and depths of dense stereo as the motion of the robot
/// requires. Not thread-safe. Throws UserError or DataError if the store cannot be written.
class LiveSensors {
 public:
  /// Statistics for the operator.
  struct Counts {
    std::size_t scans = 0;
    std::size_t sweeps = 0;         ///< stored
    std::size_t depth_images = 0;   ///< stored
    std::size_t stereo_views = 0;   ///< depths of dense stereo, stored
    std::size_t invalid_depth = 0;  ///< images that cannot be decoded
    std::size_t unplaced = 0;       ///< measurements of sensors with unknown mounting
  };
  /// Returns depths of the size of the pinhole (CV_32FC1, m along the optical axis; 0: none); empty: the image cannot
  /// be used.
  using DecodeDepth = std::function<cv::Mat()>;
  using MaybePose = std::optional<urban_nav_core::Pose>;

  explicit LiveSensors(urban_nav_store::SessionId session) : session_(std::move(session)) {}

  bool isPlaced(const std::string& frame) const {
    return lasers_.count(frame) + lidars_.count(frame) + depth_cameras_.count(frame) != 0;
  }
  /// Returns whether a planar laser measures surfaces around the robot; a horizontal one measures one height alone.
  bool hasTiltedLaser() const;

  void placeLaser(const std::string& frame, const urban_nav_core::Pose& T_base_laser);
  void placeLidar(const std::string& frame, const urban_nav_core::Pose& T_base_lidar);
  /// Cameras beyond kMostDepthCameras are ignored.
  void placeDepthCamera(const std::string& frame, const urban_nav_core::Pose& T_base_camera);

  /// Continues in an empty store, which must outlive this object or the next call.
  void begin(urban_nav_store::Store& store);
  void countUnplaced() { ++counts_.unplaced; }
  void put(const std::string& frame, const urban_nav_core::Scan& scan);
  /// `newest`: newest pose of the robot; nullopt: none yet.
  void put(const std::string& frame, const urban_nav_core::Sweep& sweep, const MaybePose& newest);
  void put(const std::string& frame, urban_nav_core::StampNs stamp, const urban_nav_core::Pinhole& pinhole,
           const DecodeDepth& decode, const MaybePose& newest);
  /// Adds depths of dense stereo, which are used if no planar laser measures surfaces around the robot.
  void put(urban_nav_core::StampNs stamp, const urban_nav_core::DepthSamples& view,
           const urban_nav_core::Pose& T_base_camera, const MaybePose& newest);

  const Counts& counts() const { return counts_; }

 private:
  struct Spaced {
    std::string role;  ///< "points0", its name in the store
    urban_nav_core::Pose T_base_sensor;
    urban_nav_core::TravelSpacing spacing{urban_nav_core::kSweepSpacing};
  };

  void storePlaces();

  const urban_nav_store::SessionId session_;
  urban_nav_store::Store* store_ = nullptr;
  std::map<std::string, urban_nav_core::Pose> lasers_;
  std::map<std::string, Spaced> lidars_;
  std::map<std::string, Spaced> depth_cameras_;
  urban_nav_core::TravelSpacing views_{urban_nav_core::kSweepSpacing};
  Counts counts_;
};

}  // namespace laser_mapper
