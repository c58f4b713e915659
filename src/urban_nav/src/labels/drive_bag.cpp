// SPDX-License-Identifier: BSD-3-Clause
#include "labels/drive_bag.hpp"

#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_msgs/TFMessage.h>

#include <filesystem>
#include <list>
#include <map>
#include <optional>

#include "input/bag_panorama.hpp"
#include "input/bag_topics.hpp"
#include "input/first_message.hpp"
#include "scene_labeler/drive/travelled_path.hpp"
#include "scene_labeler/parameters.hpp"
#include "urban_nav_core/laser/beam_renderer.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_ros/laser_scan.hpp"
#include "urban_nav_ros/recorded_image.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace urban_nav {

using scene_labeler::DriveReturn;
using scene_labeler::DriveWindow;
using urban_nav_core::DataError;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::Trajectory;
using urban_nav_core::UserError;

namespace {

constexpr StampNs longest_pose_gap = 500'000'000;            // ns: between poses, nothing is rendered in a longer one
constexpr std::array<std::size_t, 2> side_cameras = {4, 1};  // of the panoramic head, left and right

/// Laser and camera of one side.
struct SideRig {
  std::string scan_topic, image_topic;  // empty: there is none
  Pose T_base_laser, T_base_camera;
  urban_nav_core::RawCamera camera;
};

urban_nav_ros::StaticTransforms readStaticTransforms(std::list<rosbag::Bag>& bags) {
  urban_nav_ros::StaticTransforms transforms;
  for (rosbag::Bag& bag : bags) {
    rosbag::View view(bag, rosbag::TopicQuery(std::vector<std::string>{"/tf_static", "tf_static"}));
    for (const rosbag::MessageInstance& instance : view)
      if (const auto message = instance.instantiate<tf2_msgs::TFMessage>()) transforms.add(*message);
  }
  return transforms;
}

std::map<std::string, std::string> topicTypes(std::list<rosbag::Bag>& bags) {
  std::map<std::string, std::string> types;
  for (rosbag::Bag& bag : bags) {
    rosbag::View view(bag);
    for (const rosbag::ConnectionInfo* connection : view.getConnections())
      types[connection->topic] = connection->datatype;
  }
  return types;
}

std::array<SideRig, 2> readRigs(std::list<rosbag::Bag>& bags, const std::string& name, const BagTopics& topics,
                                Console& console) {
  const urban_nav_ros::StaticTransforms transforms = readStaticTransforms(bags);
  const BagPanorama head(bags, topics, transforms);
  std::array<SideRig, 2> rigs;
  for (const DriveSide side : both_sides) {
    SideRig& rig = rigs[static_cast<std::size_t>(side)];
    const auto topic = topics.find(side == DriveSide::Left ? Role::LaserLeft : Role::LaserRight);
    const auto scan = topic ? firstMessage<sensor_msgs::LaserScan>(bags, topic->name) : nullptr;
    if (!scan) continue;
    const auto T_base_laser = transforms.lookup(urban_nav_core::frames::base_link, scan->header.frame_id);
    if (!T_base_laser) {
      console.warn(name + ": no static tf from base_link to \"" + scan->header.frame_id + "\": " + topic->name +
                   " is not used");
      continue;
    }
    rig.scan_topic = topic->name;
    rig.T_base_laser = *T_base_laser;
    for (const PanoramaCamera& camera : head.cameras()) {
      if (camera.number != side_cameras[static_cast<std::size_t>(side)]) continue;
      if (!camera.T_base_camera || !camera.calibration) continue;
      rig.image_topic = camera.topic;
      rig.T_base_camera = *camera.T_base_camera;
      rig.camera = urban_nav_core::rawCamera(*camera.calibration, camera.topic);
    }
    if (rig.image_topic.empty())
      console.warn(name + ": no calibrated camera on the " + toString(side) + ": its returns are labelled by shape");
  }
  if (rigs[0].scan_topic.empty() && rigs[1].scan_topic.empty())
    throw UserError(name, "has no scans of a side laser whose place on the robot is known",
                    "--topic laser_left:=NAME, and static tf from base_link");
  return rigs;
}

/// Brings the messages of one side to its window.
class SideReader {
 public:
  SideReader(const SideRig& rig, const Trajectory& T_world_base, const scene_labeler::TravelledPath& path,
             double spacing, DriveWindow& window)
      : rig_(rig),
        T_world_base_(T_world_base),
        path_(path),
        spacing_(spacing),
        window_(window),
        renderer_(T_world_base, rig.T_base_laser, Pose(), longest_pose_gap) {}

  bool takes(const std::string& topic) const {
    return !topic.empty() && (topic == rig_.scan_topic || topic == rig_.image_topic);
  }

  void add(const rosbag::MessageInstance& instance) {
    if (const auto scan = instance.instantiate<sensor_msgs::LaserScan>()) add(*scan);
    else if (const auto raw = instance.instantiate<sensor_msgs::Image>())
      add(urban_nav_ros::RecordedImage(sensor_msgs::ImageConstPtr(raw)));
    else if (const auto packed = instance.instantiate<sensor_msgs::CompressedImage>())
      add(urban_nav_ros::RecordedImage(sensor_msgs::CompressedImageConstPtr(packed)));
  }

  void finish() { window_.finish(); }

 private:
  void add(const sensor_msgs::LaserScan& message) {
    const auto planar = urban_nav_ros::toPlanarScan(message);
    const auto travelled = planar ? path_.at(planar->stamp) : std::nullopt;
    if (!travelled || *travelled < latest_) return;
    latest_ = *travelled;
    const double wait = rig_.image_topic.empty() ? 0.0 : spacing_;
    if (latest_ >= next_ + wait) addFrame({planar->stamp, latest_, {}});
    points_.clear();
    const urban_nav_core::Scan scan = urban_nav_core::toScan(*planar);
    renderer_.render(scan, points_);
    std::size_t beam = 0, index = 0;  // of scan.beams, of planar->ranges: each skips some of the next
    for (const urban_nav_core::LaserPoint& point : points_) {
      while (scan.beams[beam].stamp != point.stamp || scan.beams[beam].range != point.range) ++beam, ++index;
      while (planar->ranges[index] != point.range) ++index;
      window_.add(DriveReturn{planar->stamp, static_cast<std::uint16_t>(index), point.intensity, latest_, point.p});
      ++beam;
      ++index;
    }
  }

  void add(const urban_nav_ros::RecordedImage& image) {
    const StampNs stamp = image.stamp();
    const auto travelled = path_.at(stamp);
    const auto T_world_base = T_world_base_.at(stamp, longest_pose_gap);
    if (!travelled || !T_world_base || *travelled < next_) return;
    const cv::Mat pixels = image.colour().pixels;
    if (pixels.cols != rig_.camera.pinhole.width || pixels.rows != rig_.camera.pinhole.height) return;
    addFrame({stamp, *travelled, {rig_.camera, *T_world_base * rig_.T_base_camera, pixels}});
  }

  void addFrame(scene_labeler::DriveFrame frame) {
    next_ = frame.travelled + spacing_;
    window_.add(std::move(frame));
  }

  const SideRig& rig_;
  const Trajectory& T_world_base_;
  const scene_labeler::TravelledPath& path_;
  const double spacing_;
  DriveWindow& window_;
  urban_nav_core::BeamRenderer renderer_;
  double next_ = 0.0, latest_ = 0.0;  // m along the path: of the next frame, of the last scan
  std::vector<urban_nav_core::LaserPoint> points_;
};

void readSides(std::list<rosbag::Bag>& bags, const std::array<SideRig, 2>& rigs, std::vector<SideReader>& sides,
               Progress& progress) {
  std::vector<std::string> topics;
  for (const SideRig& rig : rigs)
    for (const std::string& topic : {rig.scan_topic, rig.image_topic})
      if (!topic.empty()) topics.push_back(topic);
  std::int64_t done = 0;
  rosbag::View view(bags.front(), rosbag::TopicQuery(topics));
  for (const rosbag::MessageInstance& instance : view) {
    for (SideReader& side : sides)
      if (side.takes(instance.getTopic())) side.add(instance);
    if (++done % 64 == 0) progress.update(done);
  }
  for (SideReader& side : sides) side.finish();
  progress.finish(done);
}

}  // namespace

const char* toString(DriveSide side) { return side == DriveSide::Left ? "left" : "right"; }

bool isBag(const std::string& path) {
  return std::filesystem::path(path).extension() == ".bag" && !std::filesystem::is_directory(path);
}

void readDrive(const std::string& bag, const DriveOptions& options, Console& console,
               const std::array<DriveWindow*, 2>& windows) {
  const Trajectory T_world_base = readDriveTrajectory(bag, options, console);
  const scene_labeler::TravelledPath path(T_world_base);
  const double spacing = options.parameters->get(scene_labeler::table()).spacing;
  try {
    std::list<rosbag::Bag> bags;
    bags.emplace_back(bag, rosbag::bagmode::Read);
    const BagTopics topics = chooseTopics(topicTypes(bags), options.topics);
    const std::array<SideRig, 2> rigs = readRigs(bags, bag, topics, console);
    std::vector<SideReader> sides;
    for (const DriveSide side : both_sides)
      sides.emplace_back(rigs[static_cast<std::size_t>(side)], T_world_base, path, spacing,
                         *windows[static_cast<std::size_t>(side)]);
    Progress progress(console, std::filesystem::path(bag).stem().string(), "messages", 0);
    readSides(bags, rigs, sides, progress);
  } catch (const rosbag::BagException& error) {
    throw DataError(bag, std::string("cannot be read: ") + error.what(), "a whole bag");
  }
}

}  // namespace urban_nav
