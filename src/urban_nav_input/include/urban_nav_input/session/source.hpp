// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "urban_nav_core/camera/camera_info.hpp"
#include "urban_nav_core/camera/raw_camera.hpp"
#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/laser/cloud/point_times.hpp"
#include "urban_nav_core/laser/scan.hpp"
#include "urban_nav_core/laser/sweep.hpp"
#include "urban_nav_core/types/motion_input.hpp"
#include "urban_nav_core/types/specific_force.hpp"
#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_input/examination/finding.hpp"
#include "urban_nav_input/sensors/sight.hpp"
#include "urban_nav_ros/panorama_feed.hpp"
#include "urban_nav_ros/recorded_image.hpp"
#include "urban_nav_ros/stereo_feed.hpp"

namespace urban_nav_input {

/// A scan of one of the lasers of the robot.
struct LaserInput {
  std::size_t laser = 0;  ///< index in SourceInfo::lasers
  urban_nav_core::Scan scan;
};

/// A sweep of one of the 3D LiDARs of the robot, or a scan of a horizontal planar laser that is read as a sweep.
struct SweepInput {
  std::string role;  ///< "points0", "laser0"
  urban_nav_core::Pose T_base_lidar;
  urban_nav_core::Sweep sweep;
  bool is_planar = false;  ///< of a planar laser; the scan is also among the scans
  /// Motion since the sweep before this one, of any LiDAR, up to the end of this one, in order of time; empty without
  /// motion sensors.
  std::vector<urban_nav_core::MotionInput> inputs = {};
};

/// A depth image of one of the depth cameras of the robot, not decoded.
struct DepthInput {
  std::size_t camera = 0;  ///< index in SourceInfo::depth_cameras
  urban_nav_core::StampNs stamp = 0;
  sensor_msgs::ImageConstPtr raw;  ///< one of them
  sensor_msgs::CompressedImageConstPtr compressed;
};

/// An image of one of the cameras that colour the map, not decoded.
struct ColourInput {
  std::size_t camera = 0;  ///< index in SourceInfo::colour_cameras
  urban_nav_core::StampNs stamp = 0;
  urban_nav_ros::RecordedImage image;
};

/// State of the reader of a recording at the end of a bag, which the next bag may follow.
struct BagEnd {
  std::size_t bags = 0;                 ///< number of paths that have been read
  urban_nav_core::StampNs receipt = 0;  ///< of the last message
  std::string reader;                   ///< packed state: pending inputs and statistics
  std::vector<LaserInput> scans;        ///< read after the previous pair, up to here
  std::vector<urban_nav_ros::Panorama>
      panoramas;                     ///< completed after the previous pair, up to here; in order of stamps
  std::vector<SweepInput> sweeps;    ///< read after the previous item, up to here; in order of reference
  std::vector<DepthInput> depths;    ///< read after the previous item, up to here; in the order of the reader
  std::vector<ColourInput> colours;  ///< read after the previous item, up to here; in the order of the reader
};

/// An item of a Source: a decoded pair, and other data recorded since the previous one. Without a pair, only `bag_end`,
/// `scans`, `panoramas`, `sweeps`, `depths` and `colours` are set.
struct SourceItem : urban_nav_ros::DecodedPair {
  SourceItem() = default;
  SourceItem(urban_nav_ros::DecodedPair pair) : DecodedPair(std::move(pair)) {}
  std::shared_ptr<const BagEnd> bag_end;  ///< last end of a bag between the previous pair and this one; mostly null
  std::vector<LaserInput>
      scans;  ///< read since the previous pair, or since the end of that bag; in the order of the reader
  /// Completed since the previous pair, or since the end of that bag; in order of stamps. Images are in the order of
  /// SourceInfo::panorama, and are not decoded.
  std::vector<urban_nav_ros::Panorama> panoramas;
  /// Read since the previous item, or since the end of that bag; in order of their references, which may be earlier or
  /// later than the stamp of the pair. Only with SourceOptions::with_sweeps.
  std::vector<SweepInput> sweeps;
  /// Read since the previous item, or since the end of that bag; in the order of the reader. Only with
  /// SourceOptions::with_depth.
  std::vector<DepthInput> depths;
  /// Read since the previous item, or since the end of that bag; in the order of the reader. Only with
  /// SourceOptions::with_colour.
  std::vector<ColourInput> colours;
  /// Whether this is a stereo pair, complete or not. Only sources with sweeps return items without a pair: in sessions
  /// without images, and in gaps of the images.
  bool has_pair = true;
};
/// Mounting of a planar laser.
struct LaserInfo {
  std::string frame;
  urban_nav_core::Pose T_base_laser;
};

/// A topic or a file with a role.
struct InputStream {
  /// A 3D LiDAR, and the convention of its clouds.
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
  std::size_t number = 0;  ///< clockwise about the vertical axis, 0 ... 4
  std::string topic, frame;
  std::optional<urban_nav_core::Pose> T_base_camera;      ///< of its optical frame; nullopt: unknown
  std::optional<urban_nav_core::CameraInfo> calibration;  ///< nullopt: no camera_info
};

/// Depth camera of a robot.
struct DepthCamera {
  std::string role;                    ///< "depth0"
  std::string topic, frame;            ///< of its images
  urban_nav_core::Pose T_base_camera;  ///< of its optical frame
  urban_nav_core::Pinhole pinhole;
};

/// Camera that colours the map, other than a panoramic head.
struct ColourCamera {
  std::string role;                    ///< "colour0"; "left": the left camera of the stereo pair
  std::string topic, frame;            ///< of its images
  urban_nav_core::Pose T_base_camera;  ///< of the optical frame of its images
  urban_nav_core::RawCamera camera;
};

/// Properties of an input, available before its first image is decoded.
struct SourceInfo {
  std::string name;                             ///< as given by the user
  std::string kind;                             ///< "KITTI folder", "EuRoC folder", "bag"
  bool has_images = true;                       ///< false: `camera` and `T_base_camera` are invalid
  urban_nav_core::StereoCamera camera;          ///< after rectification
  urban_nav_core::Pose T_base_camera;           ///< left optical frame in base_link
  std::int64_t frames = 0;                      ///< expected stereo frames, or sweeps without images; 0: unknown
  urban_nav_core::StampNs first = 0, last = 0;  ///< of these frames, if known
  std::vector<LaserInfo> lasers;                ///< with known extrinsics
  std::string planar_role;  ///< role of the horizontal planar laser whose scans are also sweeps; empty: none
  std::vector<DepthCamera> depth_cameras;    ///< that are used; with SourceOptions::with_depth
  std::vector<ColourCamera> colour_cameras;  ///< that are used; with SourceOptions::with_colour
  std::vector<PanoramaCamera> panorama;      ///< cameras with images, ascending by number; empty: no panoramas
  std::vector<InputStream> inputs;           ///< by role
  std::vector<std::pair<std::string, std::string>> topics = {};  ///< role and topic of the stereo camera; of recordings
  std::optional<urban_nav_core::StampNs> right_delay = {};       ///< ns, as input.right_delay; of recordings
  std::vector<std::string> notes;                                ///< guesses and assumptions, for the user
};

/// Stereo pairs in order, from any kind of input, with the data of other sensors. One caller at a time, from any
/// thread.
class Source {
 public:
  virtual ~Source() = default;
  virtual const SourceInfo& info() const = 0;
  /// Returns the next item; nullopt at the end. Throws DataError if the input becomes unreadable.
  virtual std::optional<SourceItem> next() = 0;
  /// Returns defects of the input as a whole; complete after next() has returned nullopt.
  virtual std::vector<std::string> closingFaults() const { return {}; }
  /// Returns defects of the sensors of the input. Valid after next() has returned nullopt.
  virtual std::vector<Finding> sensorFindings() const { return {}; }
  /// Returns defects of the sensors found by comparison with the images. `stereo_scale`: ratio of true length to that
  /// of `sight`. Valid after next() has returned nullopt.
  virtual std::vector<Finding> sightFindings(const Sight& sight, double stereo_scale) const {
    static_cast<void>(sight), static_cast<void>(stereo_scale);
    return {};
  }
  /// Returns the end of a bag after the last pair; null without one. Valid after next() has returned nullopt.
  virtual std::shared_ptr<const BagEnd> bagEnd() const { return nullptr; }
  /// Returns scans after the last pair and end of a bag. Valid after next() has returned nullopt.
  virtual std::vector<LaserInput> scans() const { return {}; }
  /// Returns sweeps after the last item and end of a bag. Valid after next() has returned nullopt.
  virtual std::vector<SweepInput> sweeps() const { return {}; }
  /// Returns depth images after the last item and end of a bag. Valid after next() has returned nullopt.
  virtual std::vector<DepthInput> depths() const { return {}; }
  /// Returns images for colours after the last item and end of a bag. Valid after next() has returned nullopt.
  virtual std::vector<ColourInput> colours() const { return {}; }
  /// Returns panoramas after the last pair and end of a bag. Valid after next() has returned nullopt.
  virtual std::vector<urban_nav_ros::Panorama> panoramas() const { return {}; }
  /// Returns the specific forces of the accelerometer; complete after next() has returned nullopt. Empty without an
  /// accelerometer, with unknown extrinsics, or if it does not measure gravity (sensorFindings()).
  virtual std::vector<urban_nav_core::SpecificForce> forces() const { return {}; }
};

/// Reads ahead by at most `depth` items in a separate thread. Items and their order are those of `source`.
std::unique_ptr<Source> readAhead(std::unique_ptr<Source> source, int depth);

}  // namespace urban_nav_input
