// SPDX-License-Identifier: BSD-3-Clause
#include "topics/labels/drive_bag.hpp"

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/LaserScan.h>

#include <filesystem>
#include <optional>

#include "scene_labeler/drive/side_drive.hpp"
#include "scene_labeler/parameters.hpp"
#include "topics/labels/class_images.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_input/recording/bag_topics.hpp"
#include "urban_nav_input/recording/recording.hpp"
#include "urban_nav_input/session/bag_panorama.hpp"
#include "urban_nav_input/session/grey_survey.hpp"
#include "urban_nav_input/session/planar_clouds.hpp"
#include "urban_nav_ros/laser_scan.hpp"
#include "urban_nav_ros/recorded_image.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace urban_nav {

using scene_labeler::DriveWindow;
using urban_nav_core::DataError;
using urban_nav_core::Trajectory;
using urban_nav_core::UserError;

namespace {

constexpr std::array<std::size_t, 2> kSideCameras = {4, 1};  // of the panoramic head, left and right

/// Topics of one side with its rig.
struct SideTopics {
  std::string scan, image;  // may be empty
  scene_labeler::SideRig rig;
};

std::array<SideTopics, 2> readRigs(urban_nav_input::Recording& recording, const std::string& name,
                                   const urban_nav_input::BagTopics& topics, urban_nav_input::PlanarClouds& clouds,
                                   Console& console) {
  const urban_nav_ros::StaticTransforms transforms = recording.transforms();
  const urban_nav_input::BagPanorama head(recording, topics, transforms);
  std::array<SideTopics, 2> rigs;
  for (const DriveSide side : kBothSides) {
    SideTopics& rig = rigs[static_cast<std::size_t>(side)];
    const auto topic =
        topics.find(side == DriveSide::Left ? urban_nav_input::Role::LaserLeft : urban_nav_input::Role::LaserRight);
    const auto scan = topic ? clouds.first(recording, topic->name) : nullptr;
    if (!scan) continue;
    const auto T_base_laser = transforms.lookup(urban_nav_core::frames::kBaseLink, scan->header.frame_id);
    if (!T_base_laser) {
      console.warn(name + ": no static tf from base_link to \"" + scan->header.frame_id + "\": " + topic->name +
                   " is not used");
      continue;
    }
    rig.scan = topic->name;
    rig.rig.T_base_laser = *T_base_laser;
    for (const urban_nav_input::PanoramaCamera& camera : head.cameras()) {
      if (camera.number != kSideCameras[static_cast<std::size_t>(side)]) continue;
      if (!camera.T_base_camera || !camera.calibration) continue;
      rig.image = camera.topic;
      rig.rig.camera = {urban_nav_core::rawCamera(*camera.calibration, camera.topic), *camera.T_base_camera};
    }
    if (rig.image.empty())
      console.warn(name + ": no calibrated camera on the " + toString(side) +
                   ": its returns are labelled by shape "
                   "only");
  }
  if (rigs[0].scan.empty() && rigs[1].scan.empty())
    throw UserError(name, "has no scans of a side laser with a known pose on the robot",
                    "--topic laser_left:=NAME, and static tf from base_link");
  return rigs;
}

/// Passes the messages of one side to its window.
class SideReader {
 public:
  SideReader(const SideTopics& topics, const Trajectory& T_world_base, const scene_labeler::TravelledPath& path,
             double spacing, const ClassImages& classes, DriveWindow& window, const urban_nav_ros::GreyScale& scale,
             urban_nav_input::PlanarClouds& clouds)
      : topics_(topics),
        classes_(classes),
        clouds_(clouds),
        window_(window),
        scale_(scale),
        drive_(topics.rig, T_world_base, path, spacing, window) {}

  bool takes(const std::string& topic) const {
    return !topic.empty() && (topic == topics_.scan || topic == topics_.image);
  }

  void add(const urban_nav_input::RecordedMessage& message) {
    if (const auto scan = clouds_.read(message)) {
      if (const auto planar = urban_nav_ros::toPlanarScan(*scan)) drive_.add(*planar);
    } else if (const auto raw = message.as<sensor_msgs::Image>()) {
      add(urban_nav_ros::RecordedImage(sensor_msgs::ImageConstPtr(raw)));
    } else if (const auto packed = message.as<sensor_msgs::CompressedImage>()) {
      add(urban_nav_ros::RecordedImage(sensor_msgs::CompressedImageConstPtr(packed)));
    }
  }

  void finish() { window_.finish(); }

 private:
  void add(urban_nav_ros::RecordedImage image) {
    image.setScale(scale_);
    if (drive_.wants(image.stamp()))
      drive_.add(image.stamp(), image.colour().pixels, classes_.at(image.frame(), image.stamp()));
  }

  const SideTopics& topics_;
  const ClassImages& classes_;
  urban_nav_input::PlanarClouds& clouds_;
  DriveWindow& window_;
  const urban_nav_ros::GreyScale scale_;
  scene_labeler::SideDrive drive_;
};

void readSides(urban_nav_input::Recording& recording, const std::array<SideTopics, 2>& rigs,
               std::vector<SideReader>& sides, Progress& progress) {
  std::vector<std::string> topics;
  for (const SideTopics& side : rigs)
    for (const std::string& topic : {side.scan, side.image})
      if (!topic.empty()) topics.push_back(topic);
  std::int64_t done = 0;
  urban_nav_input::RecordedMessages messages = recording.messages(topics);
  while (const auto message = messages.next()) {
    for (SideReader& side : sides)
      if (side.takes(message->topic())) side.add(*message);
    if (++done % 64 == 0) progress.update(done);
  }
  for (SideReader& side : sides) side.finish();
  progress.finish(done);
}

}  // namespace

const char* toString(DriveSide side) { return side == DriveSide::Left ? "left" : "right"; }

bool isBag(const std::string& path) {
  const bool is_named = std::filesystem::path(path).extension() == ".bag" && !std::filesystem::is_directory(path);
  return is_named || urban_nav_input::isRecording(path);
}

void readDrive(const std::string& bag, const DriveOptions& options, Console& console,
               const std::array<DriveWindow*, 2>& windows) {
  const Trajectory T_world_base = readDriveTrajectory(bag, options, console);
  const scene_labeler::TravelledPath path(T_world_base);
  const scene_labeler::Parameters& parameters = options.parameters->get(scene_labeler::table());
  urban_nav_input::Recording recording(bag);
  urban_nav_input::BagTopics topics = urban_nav_input::chooseTopics(recording.topicTypes(), options.topics);
  urban_nav_input::PlanarClouds clouds(recording, {}, options.topics, topics);
  const std::array<SideTopics, 2> rigs = readRigs(recording, bag, topics, clouds, console);
  const ClassImages classes({bag}, parameters.class_topic, parameters.class_file);
  if (!parameters.class_topic.empty() && classes.size() == 0)
    throw UserError("scene_labeler.class_topic", "no sensor_msgs/Image on " + parameters.class_topic,
                    "a topic of the bag with mono8 class images");
  std::vector<std::string> images;
  for (const SideTopics& side : rigs)
    if (!side.image.empty()) images.push_back(side.image);
  const urban_nav_ros::GreyScale scale = urban_nav_input::surveyGreyRange(recording, images).scale();
  std::vector<SideReader> sides;
  for (const DriveSide side : kBothSides)
    sides.emplace_back(rigs[static_cast<std::size_t>(side)], T_world_base, path, parameters.spacing, classes,
                       *windows[static_cast<std::size_t>(side)], scale, clouds);
  Progress progress(console, std::filesystem::path(bag).stem().string(), "messages", 0);
  readSides(recording, rigs, sides, progress);
}

}  // namespace urban_nav
