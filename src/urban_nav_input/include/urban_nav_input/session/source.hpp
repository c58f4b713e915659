// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "urban_nav_core/camera/camera_info.hpp"
#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/laser/cloud/point_times.hpp"
#include "urban_nav_core/laser/scan.hpp"
#include "urban_nav_core/laser/sweep.hpp"
#include "urban_nav_core/types/specific_force.hpp"
#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_input/examination/finding.hpp"
#include "urban_nav_input/sensors/sight.hpp"
#include "urban_nav_ros/panorama_feed.hpp"
#include "urban_nav_ros/stereo_feed.hpp"

namespace urban_nav_input {

/// A turn of one of the robot's lasers.
struct LaserInput {
  std::size_t laser = 0;  ///< of SourceInfo::lasers
  urban_nav_core::Scan scan;
};

/// A sweep of one of the robot's 3D LiDARs.
struct SweepInput {
  std::string role;  ///< "points0"
  urban_nav_core::Pose T_base_lidar;
  urban_nav_core::Sweep sweep;
};

/// State of the reader of a recording at the end of a bag, which the next bag may follow.
struct BagEnd {
  std::size_t bags = 0;                            ///< of the paths it was given, so many have been read
  urban_nav_core::StampNs receipt = 0;             ///< of the last message
  std::string reader;                              ///< its state: what waits, and what has been seen
  std::vector<LaserInput> scans;                   ///< read after the pair before, up to here
  std::vector<urban_nav_ros::Panorama> panoramas;  ///< completed after the pair before, up to here; in order of stamps
  std::vector<SweepInput> sweeps;                  ///< read after the item before, up to here; in order of reference
};

/// What a Source returns at a time: a decoded pair, and what else was recorded since the previous one. Without a pair,
/// only `bag_end`, `scans`, `panoramas` and `sweeps` hold anything.
struct SourceItem : urban_nav_ros::DecodedPair {
  SourceItem() = default;
  SourceItem(urban_nav_ros::DecodedPair pair) : DecodedPair(std::move(pair)) {}
  std::shared_ptr<const BagEnd> bag_end;  ///< the last end of a bag between the pair before and this one; mostly none
  std::vector<LaserInput>
      scans;  ///< read since then, or since the end of that bag; only whoever reads knows in which order
  /// Completed since then, or since the end of that bag; in order of stamps. Images are in the order of
  /// SourceInfo::panorama, and are not decoded.
  std::vector<urban_nav_ros::Panorama> panoramas;
  /// Read since then, or since the end of that bag; in order of their references, which may be earlier or later than
  /// the stamp of the pair. Only with SourceOptions::with_sweeps.
  std::vector<SweepInput> sweeps;
  /// Whether this is a stereo pair, complete or not. Only sources with sweeps return items without a pair: those of
  /// sessions without images, and where images pause.
  bool has_pair = true;
};

struct LaserInfo {
  std::string frame;
  urban_nav_core::Pose T_base_laser;
};

/// A topic or a file that serves a role.
struct InputStream {
  /// A 3D LiDAR, and how its clouds are read.
  struct Lidar {
    urban_nav_core::Pose T_base_lidar;
    urban_nav_core::PointTimes times;
    double sweep_s = 0.0;   ///< duration of a sweep; of clouds without times, the time between them
    int rings = 0;          ///< 0: unknown
    bool deskewed = false;  ///< by the source
  };
  std::string role, topic, frame;
  std::int64_t messages = 0;
  std::optional<Lidar> lidar;  ///< of points0, points1, ... that are used
};

/// Camera of a panoramic head.
struct PanoramaCamera {
  std::size_t number = 0;  ///< about the vertical axis, clockwise, 0 ... 4
  std::string topic, frame;
  std::optional<urban_nav_core::Pose> T_base_camera;      ///< of its optical frame; nullopt: unknown
  std::optional<urban_nav_core::CameraInfo> calibration;  ///< nullopt: no camera_info
};

/// What is known of an input before its first image is decoded.
struct SourceInfo {
  std::string name;                             ///< as the user gave it
  std::string kind;                             ///< "KITTI folder", "EuRoC folder", "bag"
  bool has_images = true;                       ///< false: `camera` and `T_base_camera` mean nothing
  urban_nav_core::StereoCamera camera;          ///< after rectification
  urban_nav_core::Pose T_base_camera;           ///< left optical frame in base_link
  std::int64_t frames = 0;                      ///< stereo frames expected, sweeps without images; 0: unknown
  urban_nav_core::StampNs first = 0, last = 0;  ///< of these, as far as it is known beforehand
  std::vector<LaserInfo> lasers;                ///< whose place on the robot is known
  std::vector<PanoramaCamera> panorama;         ///< cameras with images, ascending by number; empty: no panoramas
  std::vector<InputStream> inputs;              ///< by role
  std::vector<std::pair<std::string, std::string>> topics = {};  ///< role and topic of the stereo camera; of recordings
  std::optional<urban_nav_core::StampNs> right_delay = {};       ///< ns, as input.right_delay; of recordings
  std::vector<std::string> notes;                                ///< what was guessed or assumed, for the user
};

/// Stereo pairs in order, whatever they are stored in, and what belongs to them. One caller at a time, from any thread.
class Source {
 public:
  virtual ~Source() = default;
  virtual const SourceInfo& info() const = 0;
  /// The next item; empty at the end. DataError where the input cannot be read on.
  virtual std::optional<SourceItem> next() = 0;
  /// What was wrong with the input as a whole: complete when next() has come to the end.
  virtual std::vector<std::string> closingFaults() const { return {}; }
  /// Returns what is wrong with the sensors of the input. Valid after next() has returned nullopt.
  virtual std::vector<Finding> sensorFindings() const { return {}; }
  /// Returns what is wrong with the sensors of the input by comparison with what its images show. `stereo_scale`: true
  /// length over that of `sight`. Valid after next() has returned nullopt.
  virtual std::vector<Finding> sightFindings(const Sight& sight, double stereo_scale) const {
    static_cast<void>(sight), static_cast<void>(stereo_scale);
    return {};
  }
  /// Returns the end of a bag that no pair follows; null if there is none. Valid after next() has returned nullopt.
  virtual std::shared_ptr<const BagEnd> bagEnd() const { return nullptr; }
  /// Returns scans that no pair and no end of a bag follow. Valid after next() has returned nullopt.
  virtual std::vector<LaserInput> scans() const { return {}; }
  /// Returns sweeps that no item and no end of a bag follow. Valid after next() has returned nullopt.
  virtual std::vector<SweepInput> sweeps() const { return {}; }
  /// Returns panoramas that no pair and no end of a bag follow. Valid after next() has returned nullopt.
  virtual std::vector<urban_nav_ros::Panorama> panoramas() const { return {}; }
  /// Returns the specific forces of the input's accelerometer; complete once next() has returned nullopt. Empty without
  /// an accelerometer, if its extrinsics are not known, or if it measures no gravity upwards (sensorFindings()).
  virtual std::vector<urban_nav_core::SpecificForce> forces() const { return {}; }
};

/// Reads ahead by at most `depth` items in a thread of its own. Items and their order are those of `source`.
std::unique_ptr<Source> readAhead(std::unique_ptr<Source> source, int depth);

}  // namespace urban_nav_input
