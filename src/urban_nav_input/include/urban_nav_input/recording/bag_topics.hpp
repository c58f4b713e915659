// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace urban_nav_input {

/// What a topic is to `map`. The words are those of --topic ROLE:=NAME; the topics of docs/architecture.md stand for
/// their roles too (stereo/left/image_raw:=/cam0/image_raw).
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
  Points0,
  Points1,
  Points2,
  Points3,
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

constexpr std::size_t kPointsTopics = 4;
/// Returns the role of a 3D LiDAR, 0 ... kPointsTopics - 1.
Role pointsRole(std::size_t lidar);

struct ChosenTopic {
  std::string name;
  std::string type;  ///< "sensor_msgs/Image"
};

/// Topics by role, with what to tell the user about them.
struct BagTopics {
  std::map<Role, ChosenTopic> chosen;
  std::vector<std::string> notes;
  std::optional<ChosenTopic> find(Role role) const;
  /// Returns the cameras of the panoramic head that have a topic, ascending.
  std::vector<std::size_t> panorama() const;
};

/// `available`: name and type of every topic of a bag. What `wishes` (ROLE:=NAME) do not say is guessed from types and
/// names: a stereo pair are two image topics whose names differ in "left" and "right" (or cam0 and cam1, image_0 and
/// image_1, infra1 and infra2), else the only two there are, in the order of their names. A panoramic head has at least
/// two image topics whose names contain "ladybug" or "panorama", and "camera" or "cam" with a number. 3D LiDARs are the
/// topics of clouds whose names are not those of computed clouds (a map, clusters, depth images), in the
/// order of their names. UserError for a wish that is no role, or a topic that is not there or of another type. Roles
/// for which nothing fits are absent.
BagTopics chooseTopics(const std::map<std::string, std::string>& available, const std::vector<std::string>& wishes);

bool isImageType(const std::string& type);
/// Returns whether messages of a type hold sweeps of 3D LiDARs: PointCloud2, or the CustomMsg of Livox.
bool isCloudType(const std::string& type);
bool isLivoxType(const std::string& type);
/// image_rect and its relatives are rectified already.
bool isRectifiedName(const std::string& topic);

}  // namespace urban_nav_input
