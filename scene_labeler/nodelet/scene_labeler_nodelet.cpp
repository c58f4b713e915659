// SPDX-License-Identifier: BSD-3-Clause
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/point_cloud2_iterator.h>
#include <pluginlib/class_list_macros.hpp>

#include <memory>
#include <tuple>
#include <variant>

#include "live/live_labels.hpp"
#include "live/nodelet_parameters.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_ros/camera_info.hpp"
#include "urban_nav_ros/extrinsics.hpp"
#include "urban_nav_ros/laser_scan.hpp"
#include "urban_nav_ros/recorded_image.hpp"
#include "urban_nav_ros/robot_topics.hpp"
#include "urban_nav_ros/stage_nodelet.hpp"

namespace scene_labeler {

namespace {

constexpr const char* image_topic = "labels/image";
constexpr const char* cloud_topic = "labels/cloud";
constexpr std::array<int, 2> side_cameras = {4, 1};  // of the panoramic head, left and right
constexpr double camera_timeout = 5.0;               // s

struct CameraImage {
  std::size_t side = 0;
  urban_nav_ros::RecordedImage image;
};
struct CameraCalibration {
  std::size_t side = 0;
  sensor_msgs::CameraInfoConstPtr info;
};

LabelModel readNodeletModel(const std::string& name) {
  return name == "default" ? defaultModel() : parseModel(urban_nav_core::readTextFile(name), name);
}

sensor_msgs::PointCloud2 toMessage(const std::vector<DriveReturn>& returns, const SceneLabels& labels) {
  sensor_msgs::PointCloud2 cloud;
  sensor_msgs::PointCloud2Modifier modifier(cloud);
  modifier.setPointCloud2Fields(6, "x", 1, sensor_msgs::PointField::FLOAT32, "y", 1, sensor_msgs::PointField::FLOAT32,
                                "z", 1, sensor_msgs::PointField::FLOAT32, "probability", 1,
                                sensor_msgs::PointField::FLOAT32, "label", 1, sensor_msgs::PointField::UINT8, "unsure",
                                1, sensor_msgs::PointField::UINT8);
  modifier.resize(returns.size());
  sensor_msgs::PointCloud2Iterator<float> x(cloud, "x"), probability(cloud, "probability");
  sensor_msgs::PointCloud2Iterator<std::uint8_t> label(cloud, "label"), unsure(cloud, "unsure");
  for (std::size_t i = 0; i < returns.size(); ++i, ++x, ++probability, ++label, ++unsure) {
    for (int axis = 0; axis < 3; ++axis) x[axis] = returns[i].point[axis];
    *probability = labels.probability(i);
    *label = static_cast<std::uint8_t>(labels.labels[i]);
    *unsure = labels.unsure[i];
  }
  return cloud;
}

}  // namespace

/// Labels on topics: lasers, side cameras and odometry in, labels/image and labels/cloud out.
class SceneLabelerStage {
 public:
  static constexpr const char* name = "scene_labeler";
  static constexpr const char* topic = "labels";
  using Input = std::variant<urban_nav_ros::ImageInput, urban_nav_ros::InfoInput, tf2_msgs::TFMessageConstPtr,
                             sensor_msgs::LaserScanConstPtr, urban_nav_core::StampedPose, urban_nav_core::RelativePose,
                             CameraImage, CameraCalibration>;
  using Node = urban_nav_ros::StageNodeWith<Input>;

  explicit SceneLabelerStage(Node& node);

  void handle(Input& input);
  bool idle();
  std::string reset();
  void close() {}
  urban_nav_live::StageReport report() const;

 private:
  template <typename Message>
  void subscribeCamera(std::size_t side);
  void addScan(const sensor_msgs::LaserScan& message);
  void calibrate(const CameraCalibration& calibration);
  LiveLabels::Outputs outputs();

  Node& node_;
  NodeletParameters nodelet_;
  std::unique_ptr<LiveLabels> labels_;
  urban_nav_ros::StaticTransforms transforms_;
  std::array<std::string, 2> camera_frames_;
  ros::Publisher image_, cloud_;
  std::string fault_;  // of a camera or laser without a place
};

SceneLabelerStage::SceneLabelerStage(Node& node) : node_(node) {
  Parameters parameters;
  std::tie(nodelet_, parameters) = node.parameters(nodeletTable(), table());
  node.setQueueSize(nodelet_.queue_size);
  labels_ = std::make_unique<LiveLabels>(parameters, readNodeletModel(parameters.model), outputs());
  image_ = node.nh().advertise<sensor_msgs::Image>(image_topic, 10);
  cloud_ = node.nh().advertise<sensor_msgs::PointCloud2>(cloud_topic, 10);
  subscribeRobot(node, nodelet_.queue_size, false, false, true);
  for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
    if (nodelet_.compressed) subscribeCamera<sensor_msgs::CompressedImage>(side);
    else subscribeCamera<sensor_msgs::Image>(side);
  }
}

template <typename Message>
void SceneLabelerStage::subscribeCamera(std::size_t side) {
  const std::string camera = "ladybug/camera" + std::to_string(side_cameras[side]);
  urban_nav_ros::TopicOptions options;
  options.timeout = camera_timeout;
  options.queue = 20;
  options.is_monitored = false;  // without images, returns are labelled by shape
  node_.subscribeInput<Message>(camera + "/image_raw" + (nodelet_.compressed ? "/compressed" : ""), options,
                                [side](const boost::shared_ptr<const Message>& message) {
                                  return Input(CameraImage{side, urban_nav_ros::RecordedImage(message)});
                                });
  options.is_paused = false;
  node_.subscribeInput<sensor_msgs::CameraInfo>(camera + "/camera_info", options,
                                                [side](const sensor_msgs::CameraInfoConstPtr& message) {
                                                  return Input(CameraCalibration{side, message});
                                                });
}

LiveLabels::Outputs SceneLabelerStage::outputs() {
  LiveLabels::Outputs outputs;
  outputs.cloud = [this](const std::vector<DriveReturn>& returns, const SceneLabels& labels) {
    sensor_msgs::PointCloud2 cloud = toMessage(returns, labels);
    cloud.header.frame_id = nodelet_.odom_frame;
    cloud.header.stamp = urban_nav_ros::toRosTime(returns.back().scan);
    cloud_.publish(cloud);
  };
  outputs.image = [this](std::size_t side, const DriveFrame& frame, const cv::Mat& classes) {
    if (classes.empty()) return;
    sensor_msgs::Image image = urban_nav_ros::toImageMessage(classes);
    image.header.frame_id = camera_frames_[side];
    image.header.stamp = urban_nav_ros::toRosTime(frame.stamp);
    image_.publish(image);
  };
  return outputs;
}

void SceneLabelerStage::handle(Input& input) {
  if (const auto* transforms = std::get_if<tf2_msgs::TFMessageConstPtr>(&input)) return transforms_.add(**transforms);
  if (const auto* scan = std::get_if<sensor_msgs::LaserScanConstPtr>(&input)) return addScan(**scan);
  if (const auto* pose = std::get_if<urban_nav_core::StampedPose>(&input)) return labels_->addPose(*pose);
  if (const auto* calibration = std::get_if<CameraCalibration>(&input)) return calibrate(*calibration);
  if (const auto* image = std::get_if<CameraImage>(&input)) {
    const urban_nav_ros::RecordedImage recorded = image->image;
    labels_->addImage(image->side, recorded.stamp(), [recorded] { return recorded.colour().pixels; });
  }
}

void SceneLabelerStage::addScan(const sensor_msgs::LaserScan& message) {
  const auto planar = urban_nav_ros::toPlanarScan(message);
  if (!planar) return node_.gate().countInvalid();
  const auto T_base_laser = transforms_.lookup(nodelet_.base_frame, message.header.frame_id);
  if (!T_base_laser) {
    fault_ = "no static tf from " + nodelet_.base_frame + " to " + message.header.frame_id;
    return;
  }
  const std::size_t side = T_base_laser->t().y() >= 0.0 ? 0 : 1;  // REP-103: y to the left
  if (!labels_->hasLaser(side)) labels_->setLaser(side, *T_base_laser);
  labels_->addScan(side, *planar);
}

void SceneLabelerStage::calibrate(const CameraCalibration& calibration) {
  if (labels_->hasCamera(calibration.side)) return;
  const std::string& frame = calibration.info->header.frame_id;
  const auto T_base_camera = transforms_.lookup(nodelet_.base_frame, frame);
  if (!T_base_camera) {
    fault_ = "no static tf from " + nodelet_.base_frame + " to " + frame;
    return;
  }
  try {
    const auto raw = urban_nav_core::rawCamera(urban_nav_ros::toCameraInfo(*calibration.info), frame);
    labels_->setCamera(calibration.side, {raw, *T_base_camera});
    camera_frames_[calibration.side] = frame;
  } catch (const urban_nav_core::UserError& error) {
    fault_ = error.what();
  }
}

bool SceneLabelerStage::idle() {
  const urban_nav_live::StageReport now = report();
  node_.publishStatus(now.status, now.reason_name, labels_->newest());
  return false;
}

std::string SceneLabelerStage::reset() {
  labels_->reset();
  fault_.clear();
  return "a new drive begins";
}

urban_nav_live::StageReport SceneLabelerStage::report() const {
  const std::string odometry = node_.monitor().fault(urban_nav_ros::topic_groups::odometry);
  const std::string lasers = node_.monitor().fault(urban_nav_ros::topic_groups::lasers);
  urban_nav_live::StageReport report;
  const auto set = [&](int reason, const char* reason_name, const std::string& sentence) {
    if (sentence.empty() || report.status.reason != 0 || node_.gate().isPaused()) return;
    report.status = {urban_nav_core::Health::Degraded, reason, sentence};
    report.reason_name = reason_name;
  };
  set(1, "NoOdometry", odometry);
  set(2, "NoLasers", lasers);
  set(3, "NoPlace", fault_);
  const LiveLabels::Counts counts = labels_->counts();
  report.add("scans", counts.scans);
  report.add("images", counts.images);
  report.add("poses of odometry", counts.poses);
  report.add("scans and images dropped without odometry", counts.dropped);
  report.add("frames labelled", counts.frames);
  report.add("of these with an image", counts.imaged_frames);
  return report;
}

class SceneLabelerNodelet : public urban_nav_ros::StageNodelet<SceneLabelerStage> {};

}  // namespace scene_labeler

PLUGINLIB_EXPORT_CLASS(scene_labeler::SceneLabelerNodelet, nodelet::Nodelet)
