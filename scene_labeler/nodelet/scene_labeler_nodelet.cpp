// SPDX-License-Identifier: BSD-3-Clause
#include <geometry_msgs/PointStamped.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <urban_nav_msgs/CorrectLabel.h>
#include <urban_nav_msgs/FileCommand.h>
#include <pluginlib/class_list_macros.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <thread>
#include <tuple>
#include <variant>

#include "live/live_labels.hpp"
#include "live/nodelet_parameters.hpp"
#include "scene_labeler/class_map.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_live/beam_faults.hpp"
#include "urban_nav_ros/camera_info.hpp"
#include "urban_nav_ros/extrinsics.hpp"
#include "urban_nav_ros/label_cloud.hpp"
#include "urban_nav_ros/laser_scan.hpp"
#include "urban_nav_ros/recorded_image.hpp"
#include "urban_nav_ros/robot_topics.hpp"
#include "urban_nav_ros/stage_nodelet.hpp"
#include "urban_nav_ros/sweep_feeds.hpp"
#include "urban_nav_ros/topics.hpp"

namespace scene_labeler {

namespace {

constexpr std::array<std::size_t, 2> kSideCameras = {4, 1};  // cameras of the panoramic head on the left and right side
constexpr double kCameraTimeout = 5.0;                       // s
constexpr std::chrono::milliseconds kTrainingPoll{20};
// Scans and images that arrive after the poses of their time are labelled with the next pose, or after this delay.
constexpr std::chrono::milliseconds kPosePatience{500};

struct CameraImage {
  std::size_t side = 0;
  urban_nav_ros::RecordedImage image;
};
struct ClassImage {
  sensor_msgs::ImageConstPtr image;
};
struct CameraCalibration {
  std::size_t side = 0;
  sensor_msgs::CameraInfoConstPtr info;
};

}  // namespace

/// Publishes labels/image and labels/cloud from lasers, 3D LiDARs, side cameras and odometry.
class SceneLabelerStage {
 public:
  static constexpr const char* name = "scene_labeler";
  static constexpr const char* topic = "labels";
  using Input = std::variant<urban_nav_ros::ImageInput, urban_nav_ros::InfoInput, tf2_msgs::TFMessageConstPtr,
                             sensor_msgs::LaserScanConstPtr, sensor_msgs::PointCloud2ConstPtr,
                             urban_nav_core::StampedPose, urban_nav_core::SessionStep, CameraImage, ClassImage,
                             CameraCalibration, geometry_msgs::PointStampedConstPtr>;
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
  /// Returns whether scans and images are processed.
  bool isWanted() const { return nodelet_.always || image_.getNumSubscribers() + cloud_.getNumSubscribers() > 0; }
  void addScan(const sensor_msgs::LaserScan& message);
  void addSweep(const std::string& frame, const urban_nav_core::Sweep& sweep);
  /// Returns the mounting of a sensor; nullopt, with a fault, if tf does not have it.
  std::optional<urban_nav_core::Pose> findPlace(const std::string& frame);
  void addClasses(const sensor_msgs::Image& message);
  void calibrate(const CameraCalibration& calibration);
  LiveLabels::Outputs outputs();
  void publish(sensor_msgs::PointCloud2& cloud, urban_nav_core::StampNs stamp);
  void advertiseServices();
  std::string correct(const std::string& label);
  void adoptTaughtModel();

  Node& node_;
  NodeletParameters nodelet_;
  std::unique_ptr<LiveLabels> labels_;
  urban_nav_ros::StaticTransforms transforms_;
  urban_nav_ros::SweepFeeds sweeps_{
      {[this](const std::string& frame, const urban_nav_core::Sweep& sweep) { addSweep(frame, sweep); },
       [this] { node_.gate().countInvalid(); }}};
  std::array<std::string, 2> camera_frames_;
  ros::Publisher image_, cloud_;
  std::map<std::string, std::string> faults_;  // keyed by the frame of a camera or laser
  std::chrono::steady_clock::time_point last_pose_;
  geometry_msgs::PointStampedConstPtr click_;
  std::string taught_fault_;
  std::string thresholds_;  // probability from which labels are sure, or a sentence on fixed ones
  urban_nav_live::BeamFaults beams_;
  ClassMap class_map_;                   // values of class images
  urban_nav_ros::GreyRange grey_range_;  // 16-bit pixels of both cameras
};

SceneLabelerStage::SceneLabelerStage(Node& node) : node_(node) {
  Parameters parameters;
  std::tie(nodelet_, parameters) = node.parameters(nodeletTable(), table());
  node.setQueueSize(nodelet_.queue_size, nodelet_.drain_s);
  LabelModel model = readModel(parameters.model);
  thresholds_ = thresholdNote(model.sure, parameters.precision, parameters.model);
  if (thresholds_.empty()) thresholds_ = urban_nav_core::printNumber(model.sure.rowFor(parameters.precision).least);
  labels_ = std::make_unique<LiveLabels>(parameters, std::move(model), outputs());
  image_ = node.nh().advertise<sensor_msgs::Image>(urban_nav_ros::topics::kLabelImage, 10);
  cloud_ = node.nh().advertise<sensor_msgs::PointCloud2>(urban_nav_ros::topics::kLabelCloud, 10);
  subscribeRobot(node, nodelet_.queue_size, false, false, true);
  for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
    if (nodelet_.compressed) subscribeCamera<sensor_msgs::CompressedImage>(side);
    else subscribeCamera<sensor_msgs::Image>(side);
  }
  urban_nav_ros::TopicOptions options;
  options.is_monitored = options.is_paused = false;
  if (!parameters.class_file.empty()) class_map_ = ClassMap(parameters.class_file);
  if (!parameters.class_topic.empty())
    node.subscribeInput<sensor_msgs::Image>(
        parameters.class_topic, options,
        [](const sensor_msgs::ImageConstPtr& message) { return Input(ClassImage{message}); });
  node.subscribeInput<geometry_msgs::PointStamped>(
      urban_nav_ros::topics::kClickedPoint, options,
      [](const geometry_msgs::PointStampedConstPtr& message) { return Input(message); });
  advertiseServices();
}

void SceneLabelerStage::advertiseServices() {
  node_.advertiseService<urban_nav_msgs::CorrectLabel>("correct", [this](const auto& request, auto& response) {
    response.message = node_.ask([&] { return correct(request.label); });
  });
  node_.advertiseService<urban_nav_msgs::FileCommand>("save", [this](const auto& request, auto& response) {
    response.message = node_.ask([&] {
      urban_nav_core::writeAtomically(request.path, printModel(labels_->model()));
      return "the model is in " + request.path;
    });
  });
}

std::string SceneLabelerStage::correct(const std::string& label) {
  const auto known = classFromName(label);
  if (!known) throw urban_nav_core::UserError("", "label = " + label, classNames());
  if (!click_) throw urban_nav_core::UserError("", "no clicked point", "a point of the tool publish_point of rviz");
  if (click_->header.frame_id != nodelet_.odom_frame)
    throw urban_nav_core::UserError("", "the clicked point is in frame " + click_->header.frame_id,
                                    nodelet_.odom_frame + ", as fixed frame of rviz");
  const auto& p = click_->point;
  return labels_->correct(Eigen::Vector3d(p.x, p.y, p.z).cast<float>(), *known);
}

void SceneLabelerStage::adoptTaughtModel() {
  try {
    if (!labels_->adoptTaughtModel()) return;
    taught_fault_.clear();
    node_.logInfo("labels are now from the retrained model; the service save writes it");
  } catch (const urban_nav_core::Error& error) {
    taught_fault_ = error.what();
    node_.logError(taught_fault_);
  }
}

template <typename Message>
void SceneLabelerStage::subscribeCamera(std::size_t side) {
  const std::string image = urban_nav_ros::topics::kPanoramaImages[kSideCameras[side]];
  urban_nav_ros::TopicOptions options;
  options.timeout = kCameraTimeout;
  options.queue = 20;
  options.is_monitored = false;  // without images, returns are labelled by shape
  node_.subscribeInput<Message>(image + (nodelet_.compressed ? "/compressed" : ""), options,
                                [side](const boost::shared_ptr<const Message>& message) {
                                  return Input(CameraImage{side, urban_nav_ros::RecordedImage(message)});
                                });
  options.is_paused = false;
  node_.subscribeInput<sensor_msgs::CameraInfo>(urban_nav_ros::topics::kPanoramaInfos[kSideCameras[side]], options,
                                                [side](const sensor_msgs::CameraInfoConstPtr& message) {
                                                  return Input(CameraCalibration{side, message});
                                                });
}

void SceneLabelerStage::publish(sensor_msgs::PointCloud2& cloud, urban_nav_core::StampNs stamp) {
  cloud.header.frame_id = nodelet_.odom_frame;
  cloud.header.stamp = urban_nav_ros::toRosTime(stamp);
  cloud_.publish(cloud);
}

LiveLabels::Outputs SceneLabelerStage::outputs() {
  LiveLabels::Outputs outputs;
  outputs.cloud = [this](const std::vector<DriveReturn>& returns, const SceneLabels& labels) {
    urban_nav_ros::LabelCloud cloud(returns.size());
    for (std::size_t i = 0; i < returns.size(); ++i) cloud.add(returns[i].point, labels, i);
    publish(cloud.message(), returns.back().scan);
  };
  outputs.sweep = [this](urban_nav_core::StampNs reference, const auto& returns, const SweepLabels& labels) {
    urban_nav_ros::LabelCloud cloud(labels.answered());
    for (std::size_t i = 0; i < returns.size(); ++i)
      if (const std::uint32_t row = labels.answer_of_return[i]; row != SweepLabels::kNoAnswer)
        cloud.add(returns[i].p, labels.answers, row);
    publish(cloud.message(), reference);
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
  if (const auto* cloud = std::get_if<sensor_msgs::PointCloud2ConstPtr>(&input); cloud != nullptr && isWanted())
    return sweeps_.add(*cloud);
  if (const auto* pose = std::get_if<urban_nav_core::StampedPose>(&input)) {
    last_pose_ = std::chrono::steady_clock::now();
    return labels_->addPose(*pose);
  }
  if (const auto* calibration = std::get_if<CameraCalibration>(&input)) return calibrate(*calibration);
  if (const auto* classes = std::get_if<ClassImage>(&input)) return addClasses(*classes->image);
  if (const auto* click = std::get_if<geometry_msgs::PointStampedConstPtr>(&input)) {
    click_ = *click;
    return;
  }
  const auto* image = std::get_if<CameraImage>(&input);
  if (image != nullptr && isWanted()) {
    urban_nav_ros::RecordedImage recorded = image->image;
    recorded.addTo(grey_range_);
    recorded.setScale(grey_range_.scale());
    labels_->addImage(image->side, recorded.stamp(), [recorded] { return recorded.colour().pixels; });
  }
}

void SceneLabelerStage::addScan(const sensor_msgs::LaserScan& message) {
  const auto planar = urban_nav_ros::toPlanarScan(message);
  if (!planar) return node_.gate().countInvalid();
  if (!isWanted()) return;
  beams_.add(*planar);
  const std::string& frame = message.header.frame_id;
  const auto T_base_laser = findPlace(frame);
  if (!T_base_laser) return;
  const std::size_t side = T_base_laser->t().y() >= 0.0 ? 0 : 1;  // REP-103: y to the left
  if (!labels_->hasLaser(side)) labels_->setLaser(side, *T_base_laser);
  labels_->addScan(side, *planar);
}

std::optional<urban_nav_core::Pose> SceneLabelerStage::findPlace(const std::string& frame) {
  const auto T_base_sensor = transforms_.lookup(nodelet_.base_frame, frame);
  if (T_base_sensor) faults_.erase(frame);
  else faults_[frame] = "no static tf from " + nodelet_.base_frame + " to " + frame;
  return T_base_sensor;
}

void SceneLabelerStage::addSweep(const std::string& frame, const urban_nav_core::Sweep& sweep) {
  if (!labels_->hasLidar(frame))
    if (const auto T_base_lidar = findPlace(frame)) labels_->placeLidar(frame, *T_base_lidar);
  if (labels_->hasLidar(frame)) labels_->addSweep(frame, sweep);
}

void SceneLabelerStage::addClasses(const sensor_msgs::Image& message) {
  const auto frame = std::find(camera_frames_.begin(), camera_frames_.end(), message.header.frame_id);
  if (frame == camera_frames_.end() || (message.encoding != "mono8" && message.encoding != "8UC1" &&
                                        message.encoding != "mono16" && message.encoding != "16UC1"))
    return node_.gate().countInvalid();
  labels_->addClasses(static_cast<std::size_t>(frame - camera_frames_.begin()),
                      urban_nav_ros::toStampNs(message.header.stamp),
                      toClassImage(urban_nav_ros::toGrey(message, urban_nav_ros::kPixelsAsStored).pixels, class_map_));
}

void SceneLabelerStage::calibrate(const CameraCalibration& calibration) {
  if (labels_->hasCamera(calibration.side)) return;
  const std::string& frame = calibration.info->header.frame_id;
  const auto T_base_camera = findPlace(frame);
  if (!T_base_camera) return;
  try {
    const auto raw = urban_nav_core::rawCamera(urban_nav_ros::toCameraInfo(*calibration.info), frame);
    labels_->setCamera(calibration.side, {raw, *T_base_camera});
    camera_frames_[calibration.side] = frame;
  } catch (const urban_nav_core::UserError& error) {
    faults_[frame] = error.what();
  }
}

bool SceneLabelerStage::idle() {
  adoptTaughtModel();
  if (std::chrono::steady_clock::now() - last_pose_ >= kPosePatience) labels_->catchUp();
  const bool has_labelled = labels_->labelSweep();
  const urban_nav_live::StageReport now = report();
  node_.publishStatus(now.status, now.reason_name, labels_->newest());
  if (has_labelled || !labels_->teaching().isTraining()) return has_labelled;
  std::this_thread::sleep_for(kTrainingPoll);  // polls progress and the retrained model without waiting for an input
  return true;
}

std::string SceneLabelerStage::reset() {
  labels_->reset();
  faults_.clear();
  return "a new drive was begun";
}

urban_nav_live::StageReport SceneLabelerStage::report() const {
  const std::string odometry = node_.monitor().fault(urban_nav_ros::topic_groups::kOdometry);
  const std::string lasers = node_.monitor().fault(urban_nav_ros::topic_groups::kLasers);
  const bool is_wanted = isWanted();
  urban_nav_live::StageReport report;
  if (!is_wanted) report.summary = "idle: no subscriber to labels/image or labels/cloud";
  const auto set = [&](int reason, const char* reason_name, const std::string& sentence) {
    if (sentence.empty() || report.status.reason != 0 || node_.gate().isPaused() || !is_wanted) return;
    report.status = {urban_nav_core::Health::Degraded, reason, sentence};
    report.reason_name = reason_name;
  };
  set(1, "NoOdometry", odometry);
  const LiveLabels::Counts counts = labels_->counts();
  if (counts.sweeps.sweeps == 0) set(2, "NoLasers", lasers);
  if (!faults_.empty()) set(3, "NoPlace", faults_.begin()->second);
  set(4, "NotTaught", taught_fault_);
  set(5, "UpsideDown", counts.upside_down_frames == 0 ? "" : "a side camera appears to be mounted upside down");
  set(2, "NoLasers", sweeps_.fault());
  set(6, "TooSlow", labels_->sweepFault());
  report.add("probability of sure labels", thresholds_);
  counts.addTo(report);
  beams_.addTo(report);
  const LiveTeaching& teaching = labels_->teaching();
  report.add("corrections", teaching.corrections());
  report.add("training",
             teaching.isTraining() ? std::to_string(std::lround(100.0 * teaching.progress())) + " %" : "none");
  return report;
}

class SceneLabelerNodelet : public urban_nav_ros::StageNodelet<SceneLabelerStage> {};

}  // namespace scene_labeler

PLUGINLIB_EXPORT_CLASS(scene_labeler::SceneLabelerNodelet, nodelet::Nodelet)
