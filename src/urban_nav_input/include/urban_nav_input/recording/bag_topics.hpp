// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace urban_nav_input {

/// Role of a topic for `map`, as in --topic ROLE:=NAME; the topics of docs/architecture.md are also accepted as roles
/// (stereo/left/image_raw:=/cam0/image_raw).
enum class Role {
  Left,
  Right,
  LeftInfo,
  RightInfo,
  Imu,
  Wheels,
  LaserLeft,
  LaserRight,
  Truth,
  Gps,
  Laser0,
  Laser1,
  Laser2,
  Laser3,
  Points0,
  Points1,
  Points2,
  Points3,
  Depth0,
  Depth1,
  Depth2,
  Depth3,
  Depth0Info,
  Depth1Info,
  Depth2Info,
  Depth3Info,
  Colour0,
  Colour1,
  Colour2,
  Colour3,
  Colour0Info,
  Colour1Info,
  Colour2Info,
  Colour3Info,
  Panorama0,
  Panorama1,
  Panorama2,
  Panorama3,
  Panorama4,
  Panorama0Info,
  Panorama1Info,
  Panorama2Info,
  Panorama3Info,
  Panorama4Info
};
const char* toString(Role role);

constexpr std::size_t kPanoramaCameras = 5;
/// Return the roles of a camera of the panoramic head, 0 ... kPanoramaCameras - 1.
Role panoramaRole(std::size_t camera);
Role panoramaInfoRole(std::size_t camera);

constexpr std::size_t kFurtherLasers = 4;
/// Returns the role of a planar laser other than `laser_left` and `laser_right`, 0 ... kFurtherLasers - 1.
Role laserRole(std::size_t laser);

constexpr std::size_t kPointsTopics = 4;
/// Returns the role of a 3D LiDAR, 0 ... kPointsTopics - 1.
Role pointsRole(std::size_t lidar);

constexpr std::size_t kDepthCameras = 4;
/// Return the roles of a depth camera, 0 ... kDepthCameras - 1.
Role depthRole(std::size_t camera);
Role depthInfoRole(std::size_t camera);

constexpr std::size_t kColourCameras = 4;
/// Return the roles of a camera that colours the map, 0 ... kColourCameras - 1.
Role colourRole(std::size_t camera);
Role colourInfoRole(std::size_t camera);

/// Topic of a bag that is read for a role.
struct ChosenTopic {
  std::string name;
  std::string type;  ///< "sensor_msgs/Image"
};

/// Topics by role, with notes for the user.
struct BagTopics {
  std::map<Role, ChosenTopic> chosen;
  std::vector<std::string> notes;
  std::optional<ChosenTopic> find(Role role) const;
  /// Returns the cameras of the panoramic head that have a topic, ascending.
  std::vector<std::size_t> panorama() const;
};

/// Chooses topics for the roles. `available`: name and type of every topic of a bag. Roles that are not in `wishes`
/// (ROLE:=NAME) are guessed from types and names: a stereo pair is two image topics whose names differ in "left" and
/// "right" (or cam0 and cam1, image_0 and image_1, infra1 and infra2), else the only two image topics, in the order of
/// their names. A panoramic head has at least two image topics whose names contain "ladybug" or "panorama", and
/// "camera" or "cam" with a number. 3D LiDARs are the topics of clouds whose names are not those of computed clouds (a
/// map, clusters, depth images), in the order of their names. Further planar lasers are the other topics of scans whose
/// names are not those of computed ones: "scan" first, then in the order of their names. A depth camera is a namespace
/// with images named "depth": those not aligned to another camera first, raw before compressed ones. Cameras that
/// colour the map are the remaining images with a camera_info in their namespace and no name of computed images, one
/// topic of each namespace: those named after colours first. A wish
/// `preset:=NAME` takes the topics of a driver (driver_presets.hpp) for the roles that no other wish names. Throws
/// UserError for an unknown role or preset in `wishes`, or a topic that is missing or of another type. Roles without a
/// suitable topic are absent.
BagTopics chooseTopics(const std::map<std::string, std::string>& available, const std::vector<std::string>& wishes);

bool isImageType(const std::string& type);
/// Returns whether messages of a type hold sweeps of 3D LiDARs: PointCloud2, or the CustomMsg of Livox.
bool isCloudType(const std::string& type);
bool isLivoxType(const std::string& type);
/// Returns whether the topic name is that of rectified images (image_rect and variants).
bool isRectifiedName(const std::string& topic);

}  // namespace urban_nav_input
