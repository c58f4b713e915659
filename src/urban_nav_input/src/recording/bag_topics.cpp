// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/recording/bag_topics.hpp"

#include <algorithm>
#include <array>
#include <set>

#include "recording/camera_topics.hpp"
#include "recording/preset_topics.hpp"
#include "recording/role_names.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_ros/topics.hpp"

namespace urban_nav_input {

using urban_nav_core::UserError;

namespace {

namespace topics = urban_nav_ros::topics;

struct RoleNames {
  Role role;
  const char* word;
  const char* topic;  // of docs/architecture.md; null: none
};
constexpr std::array<RoleNames, 44> kRoles = {{{Role::Left, "left", topics::kLeftImage},
                                               {Role::Right, "right", topics::kRightImage},
                                               {Role::LeftInfo, "left_info", topics::kLeftInfo},
                                               {Role::RightInfo, "right_info", topics::kRightInfo},
                                               {Role::Imu, "imu", topics::kImu},
                                               {Role::Wheels, "wheels", topics::kWheelOdometry},
                                               {Role::LaserLeft, "laser_left", topics::kLaserLeft},
                                               {Role::LaserRight, "laser_right", topics::kLaserRight},
                                               {Role::Truth, "truth", topics::kTruthPose},
                                               {Role::Gps, "gps", topics::kGpsFix},
                                               {Role::Laser0, "laser0", topics::kScan},
                                               {Role::Laser1, "laser1", nullptr},
                                               {Role::Laser2, "laser2", nullptr},
                                               {Role::Laser3, "laser3", nullptr},
                                               {Role::Points0, "points0", topics::kPoints},
                                               {Role::Points1, "points1", nullptr},
                                               {Role::Points2, "points2", nullptr},
                                               {Role::Points3, "points3", nullptr},
                                               {Role::Depth0, "depth0", nullptr},
                                               {Role::Depth1, "depth1", nullptr},
                                               {Role::Depth2, "depth2", nullptr},
                                               {Role::Depth3, "depth3", nullptr},
                                               {Role::Depth0Info, "depth0_info", nullptr},
                                               {Role::Depth1Info, "depth1_info", nullptr},
                                               {Role::Depth2Info, "depth2_info", nullptr},
                                               {Role::Depth3Info, "depth3_info", nullptr},
                                               {Role::Colour0, "colour0", nullptr},
                                               {Role::Colour1, "colour1", nullptr},
                                               {Role::Colour2, "colour2", nullptr},
                                               {Role::Colour3, "colour3", nullptr},
                                               {Role::Colour0Info, "colour0_info", nullptr},
                                               {Role::Colour1Info, "colour1_info", nullptr},
                                               {Role::Colour2Info, "colour2_info", nullptr},
                                               {Role::Colour3Info, "colour3_info", nullptr},
                                               {Role::Panorama0, "panorama0", topics::kPanoramaImages[0]},
                                               {Role::Panorama1, "panorama1", topics::kPanoramaImages[1]},
                                               {Role::Panorama2, "panorama2", topics::kPanoramaImages[2]},
                                               {Role::Panorama3, "panorama3", topics::kPanoramaImages[3]},
                                               {Role::Panorama4, "panorama4", topics::kPanoramaImages[4]},
                                               {Role::Panorama0Info, "panorama0_info", topics::kPanoramaInfos[0]},
                                               {Role::Panorama1Info, "panorama1_info", topics::kPanoramaInfos[1]},
                                               {Role::Panorama2Info, "panorama2_info", topics::kPanoramaInfos[2]},
                                               {Role::Panorama3Info, "panorama3_info", topics::kPanoramaInfos[3]},
                                               {Role::Panorama4Info, "panorama4_info", topics::kPanoramaInfos[4]}}};

constexpr std::array<std::array<const char*, 2>, 7> kSides = {{{"left", "right"},
                                                               {"cam0", "cam1"},
                                                               {"cam_0", "cam_1"},
                                                               {"image_00", "image_01"},
                                                               {"image_0", "image_1"},
                                                               {"infra1", "infra2"},
                                                               {"camera0", "camera1"}}};

std::string bare(const std::string& topic) { return topic.empty() || topic.front() != '/' ? topic : topic.substr(1); }

std::string roleWords() {
  std::string words;
  for (const RoleNames& names : kRoles) words += (words.empty() ? "" : ", ") + std::string(names.word);
  return words;
}

/// Finds a topic by its name with or without the leading slash.
std::map<std::string, std::string>::const_iterator findTopic(const std::map<std::string, std::string>& available,
                                                             const std::string& name) {
  return std::find_if(available.begin(), available.end(),
                      [&](const auto& topic) { return bare(topic.first) == bare(name); });
}

void take(const std::map<std::string, std::string>& available, const std::string& wish, BagTopics& topics) {
  const std::size_t sign = wish.find(":=");
  if (sign == std::string::npos)
    throw UserError("--topic", "\"" + wish + "\"", "ROLE:=NAME with a role of " + roleWords());
  const std::string role = wish.substr(0, sign), name = wish.substr(sign + 2);
  const auto names = std::find_if(kRoles.begin(), kRoles.end(), [&](const RoleNames& r) {
    return role == r.word || (r.topic && bare(role) == r.topic);
  });
  if (names == kRoles.end()) throw UserError("--topic", "role \"" + role + "\"", roleWords());
  const auto topic = findTopic(available, name);
  if (topic == available.end() || !fits(names->role, topic->second)) {
    std::string candidates;
    for (const auto& [known, type] : available) {
      if (fits(names->role, type)) candidates += (candidates.empty() ? "" : ", ") + known;
    }
    const std::string found = topic == available.end() ? "is not in the bag" : "is of type " + topic->second;
    throw UserError("--topic " + wish, name + " " + found,
                    candidates.empty() ? "none: the bag has no topic of this type" : candidates);
  }
  topics.chosen[names->role] = {topic->first, topic->second};
}

constexpr int kOdd = 100;  // oddness of topics that are not suitable images

/// Returns a penalty for a topic as input of `map`: raw streams are preferred, rectified ones can be requested.
int oddness(const std::string& topic, const std::string& type) {
  int value = 0;
  for (const char* word : {"disparity", "depth", "theora", "color", "colour", "ladybug", "debug", "mask", "label"})
    value += contains(topic, word) ? kOdd : 0;
  value += isRectifiedName(topic) ? 10 : 0;
  value += contains(topic, "stereo") ? 0 : 2;
  value += contains(topic, "image") ? 0 : 4;
  value += type == "sensor_msgs/CompressedImage" ? 1 : 0;
  return value;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

/// Returns possible names of the other camera: one occurrence of the word replaced, beginning with the last one, so
/// that both images are of one head (.../left/cam/left with .../left/cam/right), then all of them.
std::vector<std::string> otherNames(const std::string& text, const std::string& from, const std::string& to) {
  std::vector<std::string> names;
  for (std::size_t at = text.rfind(from); at != std::string::npos;
       at = at == 0 ? std::string::npos : text.rfind(from, at - 1))
    names.push_back(text.substr(0, at) + to + text.substr(at + from.size()));
  names.push_back(replaced(text, from, to));
  return names;
}

/// Returns the only two image streams, in the order of their names, if names give no sides. Excludes raw and rectified
/// images of one camera, and depth with colour.
std::pair<ChosenTopic, ChosenTopic> onlyPair(const std::map<std::string, std::string>& available) {
  std::vector<ChosenTopic> images;
  for (const auto& [topic, type] : available) {
    if (isImageType(type)) images.push_back({topic, type});
  }
  if (images.size() != 2 || images[0].type != images[1].type ||
      isRectifiedName(images[0].name) != isRectifiedName(images[1].name))
    return {};
  const bool odd = std::any_of(images.begin(), images.end(),
                               [](const ChosenTopic& topic) { return oddness(topic.name, topic.type) >= kOdd; });
  return odd ? std::pair<ChosenTopic, ChosenTopic>() : std::make_pair(images[0], images[1]);
}

void guessImages(const std::map<std::string, std::string>& available, BagTopics& topics) {
  int best = 1 << 20;
  std::pair<ChosenTopic, ChosenTopic> pair;
  for (const auto& [left, type] : available) {
    if (!isImageType(type)) continue;
    const std::optional<ChosenTopic> wished_left = topics.find(Role::Left), wished_right = topics.find(Role::Right);
    if (wished_left && wished_left->name != left) continue;
    for (std::size_t i = 0; i < kSides.size(); ++i) {
      if (!contains(left, kSides[i][0])) continue;
      for (const std::string& name : otherNames(left, kSides[i][0], kSides[i][1])) {
        const auto right = available.find(name);
        if (right == available.end() || right->second != type || (wished_right && wished_right->name != right->first))
          continue;
        const int value = oddness(left, type) + static_cast<int>(i);
        if (value < best) {
          best = value;
          pair = {{left, type}, {right->first, type}};
        }
        break;
      }
    }
  }
  if (pair.first.name.empty()) {
    pair = onlyPair(available);
    const std::optional<ChosenTopic> left = topics.find(Role::Left), right = topics.find(Role::Right);
    if ((left && left->name == pair.second.name) || (right && right->name == pair.first.name))
      std::swap(pair.first, pair.second);
  }
  if (pair.first.name.empty()) return;
  if (!topics.find(Role::Left)) topics.chosen[Role::Left] = pair.first;
  if (!topics.find(Role::Right)) topics.chosen[Role::Right] = pair.second;
}

/// If there is no camera_info in the namespaces of the images: uses the only two remaining ones, by their sides, else
/// in the order of their names.
void guessOtherInfos(const std::map<std::string, std::string>& available, BagTopics& topics) {
  if (topics.find(Role::LeftInfo) || topics.find(Role::RightInfo)) return;
  std::vector<ChosenTopic> infos;
  for (const auto& [topic, type] : available) {
    if (fits(Role::LeftInfo, type)) infos.push_back({topic, type});
  }
  if (infos.size() != 2) return;
  for (const auto& side : kSides) {
    if (contains(infos[1].name, side[0]) && replaced(infos[1].name, side[0], side[1]) == infos[0].name)
      std::swap(infos[0], infos[1]);
  }
  topics.chosen[Role::LeftInfo] = infos[0];
  topics.chosen[Role::RightInfo] = infos[1];
}

/// Finds the cameras of a panoramic head by name, unless given by the user: the first topic of each camera.
void guessPanorama(const std::map<std::string, std::string>& available, BagTopics& topics) {
  if (topics.panorama().empty()) {
    for (std::size_t camera = 0; camera < kPanoramaCameras; ++camera)
      for (const auto& [topic, type] : available) {
        const std::string number = std::to_string(camera);
        if (!isImageType(type) || !(contains(topic, "ladybug") || contains(topic, "panorama")) ||
            !(contains(topic, "camera" + number) || contains(topic, "cam" + number)))
          continue;
        topics.chosen[panoramaRole(camera)] = {topic, type};
        break;
      }
    if (topics.panorama().size() < 2)
      for (const std::size_t camera : topics.panorama()) topics.chosen.erase(panoramaRole(camera));
  }
  for (const std::size_t camera : topics.panorama())
    guessInfo(available, panoramaRole(camera), panoramaInfoRole(camera), topics);
}

/// Returns the candidates for a stereo pair: all topics except those of a panoramic head.
std::map<std::string, std::string> withoutPanorama(std::map<std::string, std::string> available,
                                                   const BagTopics& topics) {
  for (const std::size_t camera : topics.panorama())
    for (const Role role : {panoramaRole(camera), panoramaInfoRole(camera)})
      if (const auto topic = topics.find(role)) available.erase(topic->name);
  return available;
}

/// Returns the parts of a name between slashes and underscores.
std::vector<std::string> splitName(const std::string& topic) {
  std::vector<std::string> parts(1);
  for (const char letter : topic) {
    if (letter == '/' || letter == '_') parts.emplace_back();
    else parts.back() += letter;
  }
  return parts;
}

/// Returns whether a topic name is that of clouds or scans computed from others or from images.
bool isDerived(const std::string& topic) {
  static const std::set<std::string> kWords = {
      "map",         "submap",     "clusters", "cluster",   "obstacles", "obstacle",    "objects",   "object",
      "segmented",   "ground",     "filtered", "depth",     "camera",    "stereo",      "voxel",     "voxels",
      "downsampled", "registered", "aligned",  "deskewed",  "corner",    "undistorted", "surf",      "features",
      "feature",     "normals",    "debug",    "keyframes", "costmap",   "radar",       "disparity", "trajectory"};
  const std::vector<std::string> parts = splitName(topic);
  return std::any_of(parts.begin(), parts.end(), [](const std::string& part) { return kWords.count(part) > 0; });
}

/// Assigns further topics to the roles not given by the user.
void guessPoints(const std::map<std::string, std::string>& available, BagTopics& topics) {
  std::size_t lidar = 0;
  for (const auto& [topic, type] : available) {
    if (!isCloudType(type) || isDerived(topic) || isTaken(topics, topic)) continue;
    while (lidar < kPointsTopics && topics.find(pointsRole(lidar))) ++lidar;
    if (lidar == kPointsTopics) return;
    topics.chosen[pointsRole(lidar)] = {topic, type};
  }
}

/// Assigns further topics of scans to the roles laser0, laser1, ...: "scan" first.
void guessLasers(const std::map<std::string, std::string>& available, BagTopics& topics) {
  std::vector<ChosenTopic> scans;
  for (const auto& [topic, type] : available)
    if (fits(Role::Laser0, type) && !isDerived(topic) && !isTaken(topics, topic)) scans.push_back({topic, type});
  std::stable_partition(scans.begin(), scans.end(),
                        [](const ChosenTopic& scan) { return bare(scan.name) == urban_nav_ros::topics::kScan; });
  std::size_t laser = 0;
  for (ChosenTopic& scan : scans) {
    while (laser < kFurtherLasers && topics.find(laserRole(laser))) ++laser;
    if (laser == kFurtherLasers) return;
    topics.chosen[laserRole(laser)] = std::move(scan);
  }
}

/// Adds one line per role; panoramas share one.
void noteTopics(const std::map<Role, ChosenTopic>& wished, const std::map<Role, std::string>& presets,
                BagTopics& topics) {
  const std::vector<std::size_t> panorama = topics.panorama();
  for (const auto& [role, topic] : topics.chosen) {
    const auto preset = presets.find(role);
    const std::string guessed = preset != presets.end()   ? " (preset " + preset->second + ")"
                                : wished.count(role) != 0 ? ""
                                                          : " (guessed)";
    if (role < Role::Panorama0) topics.notes.push_back(std::string(toString(role)) + ": " + topic.name + guessed);
    else if (role == panoramaRole(panorama.front()))
      topics.notes.push_back(std::to_string(panorama.size()) + " cameras of a panorama: " + topic.name +
                             (panorama.size() > 1 ? " ..." : "") + guessed);
  }
}

void guessOther(const std::map<std::string, std::string>& available, const RoleNames& names,
                const std::vector<std::string>& words, BagTopics& topics) {
  if (topics.find(names.role)) return;
  for (const std::string& word : words) {
    for (const auto& [topic, type] : available) {
      if (fits(names.role, type) && (bare(topic) == names.topic || contains(topic, word))) {
        topics.chosen[names.role] = {topic, type};
        return;
      }
    }
  }
}

}  // namespace

bool fits(Role role, const std::string& type) {
  switch (role) {
    case Role::Left:
    case Role::Right:
    case Role::Depth0:
    case Role::Depth1:
    case Role::Depth2:
    case Role::Depth3:
    case Role::Colour0:
    case Role::Colour1:
    case Role::Colour2:
    case Role::Colour3:
    case Role::Panorama0:
    case Role::Panorama1:
    case Role::Panorama2:
    case Role::Panorama3:
    case Role::Panorama4: return isImageType(type);
    case Role::LeftInfo:
    case Role::RightInfo:
    case Role::Depth0Info:
    case Role::Depth1Info:
    case Role::Depth2Info:
    case Role::Depth3Info:
    case Role::Colour0Info:
    case Role::Colour1Info:
    case Role::Colour2Info:
    case Role::Colour3Info:
    case Role::Panorama0Info:
    case Role::Panorama1Info:
    case Role::Panorama2Info:
    case Role::Panorama3Info:
    case Role::Panorama4Info: return type == "sensor_msgs/CameraInfo";
    case Role::Imu: return type == "sensor_msgs/Imu";
    case Role::Wheels: return type == "nav_msgs/Odometry";
    case Role::LaserLeft:
    case Role::LaserRight:
    case Role::Laser0:
    case Role::Laser1:
    case Role::Laser2:
    case Role::Laser3: return type == "sensor_msgs/LaserScan";
    case Role::Truth: return type == "geometry_msgs/PoseStamped";
    case Role::Gps: return type == "sensor_msgs/NavSatFix";
    case Role::Points0:
    case Role::Points1:
    case Role::Points2:
    case Role::Points3: return isCloudType(type);
  }
  return false;
}

std::optional<Role> roleFromWord(const std::string& word) {
  const auto names =
      std::find_if(kRoles.begin(), kRoles.end(), [&](const RoleNames& each) { return word == each.word; });
  return names == kRoles.end() ? std::nullopt : std::optional(names->role);
}

const char* toString(Role role) {
  return std::find_if(kRoles.begin(), kRoles.end(), [role](const RoleNames& names) { return names.role == role; })
      ->word;
}

Role panoramaRole(std::size_t camera) { return static_cast<Role>(static_cast<std::size_t>(Role::Panorama0) + camera); }

Role panoramaInfoRole(std::size_t camera) {
  return static_cast<Role>(static_cast<std::size_t>(Role::Panorama0Info) + camera);
}

Role laserRole(std::size_t laser) { return static_cast<Role>(static_cast<std::size_t>(Role::Laser0) + laser); }

Role depthRole(std::size_t camera) { return static_cast<Role>(static_cast<std::size_t>(Role::Depth0) + camera); }

Role depthInfoRole(std::size_t camera) {
  return static_cast<Role>(static_cast<std::size_t>(Role::Depth0Info) + camera);
}

Role colourRole(std::size_t camera) { return static_cast<Role>(static_cast<std::size_t>(Role::Colour0) + camera); }

Role colourInfoRole(std::size_t camera) {
  return static_cast<Role>(static_cast<std::size_t>(Role::Colour0Info) + camera);
}

Role pointsRole(std::size_t lidar) { return static_cast<Role>(static_cast<std::size_t>(Role::Points0) + lidar); }

std::vector<std::size_t> BagTopics::panorama() const {
  std::vector<std::size_t> cameras;
  for (std::size_t camera = 0; camera < kPanoramaCameras; ++camera)
    if (find(panoramaRole(camera))) cameras.push_back(camera);
  return cameras;
}

std::optional<ChosenTopic> BagTopics::find(Role role) const {
  const auto found = chosen.find(role);
  return found == chosen.end() ? std::nullopt : std::optional<ChosenTopic>(found->second);
}

BagTopics chooseTopics(const std::map<std::string, std::string>& available, const std::vector<std::string>& wishes) {
  BagTopics topics;
  for (const std::string& wish : wishes)
    if (!findPresetWish(wish)) take(available, wish, topics);
  std::map<Role, std::string> presets;
  for (const std::string& wish : wishes)
    if (const auto preset = findPresetWish(wish)) takePreset(available, *preset, topics, presets);
  const std::map<Role, ChosenTopic> wished = topics.chosen;
  guessPanorama(available, topics);
  const std::map<std::string, std::string> others = withoutPanorama(available, topics);
  guessImages(others, topics);
  guessInfo(others, Role::Left, Role::LeftInfo, topics);
  guessInfo(others, Role::Right, Role::RightInfo, topics);
  guessOtherInfos(others, topics);
  guessOther(available, kRoles[4], {"imu"}, topics);
  guessOther(available, kRoles[5], {"wheel"}, topics);
  guessOther(available, kRoles[6], {"left"}, topics);
  guessOther(available, kRoles[7], {"right"}, topics);
  guessOther(available, kRoles[8], {"ground_truth", "groundtruth"}, topics);
  guessOther(available, kRoles[9], {"gps", "fix", "gnss"}, topics);
  guessLasers(available, topics);
  guessDepth(others, topics);
  guessColour(others, topics);
  guessPoints(available, topics);
  noteTopics(wished, presets, topics);
  if (topics.chosen.size() > wished.size())
    topics.notes.push_back("guessed from types and names; override with --topic ROLE:=NAME");
  return topics;
}

bool isImageType(const std::string& type) {
  return type == "sensor_msgs/Image" || type == "sensor_msgs/CompressedImage";
}

bool isLivoxType(const std::string& type) {
  const std::size_t slash = type.find('/');
  return type.compare(0, 5, "livox") == 0 && slash != std::string::npos &&
         type.compare(slash, type.npos, "/CustomMsg") == 0;
}

bool isCloudType(const std::string& type) { return type == "sensor_msgs/PointCloud2" || isLivoxType(type); }

bool isRectifiedName(const std::string& topic) { return contains(topic, "rect"); }

}  // namespace urban_nav_input
