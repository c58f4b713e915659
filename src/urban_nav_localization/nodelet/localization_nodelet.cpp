// SPDX-License-Identifier: BSD-3-Clause
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <pluginlib/class_list_macros.hpp>
#include <pluginlib/class_loader.hpp>

#include <atomic>
#include <memory>
#include <tuple>
#include <type_traits>
#include <utility>

#include "initial_pose.hpp"
#include "live/localization_report.hpp"
#include "live/nodelet_parameters.hpp"
#include "publisher.hpp"
#include "urban_nav_ros/robot_inputs.hpp"
#include "urban_nav_ros/robot_topics.hpp"
#include "urban_nav_ros/stage_nodelet.hpp"
#include "urban_nav_ros/topics.hpp"
#include "urban_nav_store/stored_ids.hpp"

namespace urban_nav_localization {

using urban_nav_core::Error;
using urban_nav_core::UserError;
using urban_nav_registration::KeyframeRetrieval;
using urban_nav_ros::ImageInput;
using urban_nav_ros::InfoInput;
using urban_nav_store::Store;

namespace {

constexpr const char* kPlaceRecognition = "fabmap_node/KeyframePlaces";  // plugin that finds keyframes of the map

}  // namespace

/// Localization on topics, in a map that is not changed.
class LocalizationStage {
 public:
  static constexpr const char* name = "localization";
  static constexpr const char* topic = "localization";
  using Input = std::variant<ImageInput, InfoInput, tf2_msgs::TFMessageConstPtr, sensor_msgs::LaserScanConstPtr,
                             sensor_msgs::PointCloud2ConstPtr, urban_nav_core::StampedTurn, urban_nav_core::StampedPose,
                             urban_nav_core::SessionStep, LiveLocaliser::InitialPose>;
  using Node = urban_nav_ros::StageNodeWith<Input>;

  explicit LocalizationStage(Node& node);

  void handle(Input& input);
  bool idle();
  std::string reset() {
    localiser_->restart();
    return "the pose of the robot is unknown from now on";
  }
  void close() {}
  urban_nav_live::StageReport report() const;

 private:
  using Inputs = urban_nav_ros::RobotInputs<LiveLocaliser, urban_nav_registration::MountedCamera>;
  /// Throws UserError that names the parameter.
  void openMap();
  /// Returns the place recognition. Throws UserError if it is not installed.
  std::shared_ptr<KeyframeRetrieval> makeRetrieval();
  void subscribe();

  Node& node_;
  NodeletParameters nodelet_;
  Parameters parameters_;
  std::vector<urban_nav_store::StoredTrajectory> map_;
  bool has_keyframes_ = true;  // of the map
  std::unique_ptr<LocalizationPublisher> publisher_;
  pluginlib::ClassLoader<KeyframeRetrieval> plugins_{"urban_nav_registration",
                                                     "urban_nav_registration::KeyframeRetrieval"};
  std::unique_ptr<LiveLocaliser> localiser_;
  std::unique_ptr<Inputs> inputs_;
  std::string map_fault_;
  std::atomic<std::int64_t> initial_poses_refused_{0};
};

LocalizationStage::LocalizationStage(Node& node) : node_(node) {
  std::tie(nodelet_, parameters_, parameters_.registration) = urban_nav_ros::readParameters(
      node.nh(), node.privateHandle(), nodeletTable(), table(), urban_nav_registration::table());
  node.setQueueSize(nodelet_.queue_size, nodelet_.drain_s);
  openMap();
  inputs_ = std::make_unique<Inputs>(urban_nav_ros::toStereoOptions(nodelet_, node.nh()), *localiser_,
                                     Inputs::Listener{[this](const std::string& fault) { node_.logError(fault); },
                                                      [this] { node_.gate().countInvalid(); }});
  subscribe();
}

void LocalizationStage::openMap() {
  const std::string parameter = node_.privateHandle().resolveName("store");
  if (nodelet_.store.empty() || nodelet_.store.front() != '/')
    throw UserError(parameter, "`" + nodelet_.store + "`", "the absolute path of a session store");
  try {
    Store store = urban_nav_store::openForReading(nodelet_.store, urban_nav_store::Access::Frozen);
    FrozenMap map(store);
    map_ = map.sessions();
    has_keyframes_ = map.hasKeyframes();
    publisher_ = std::make_unique<LocalizationPublisher>(node_.nh(), nodelet_);
    publisher_->publish(map_);
    publisher_->publish(LocalizationEstimate(), std::nullopt);
    localiser_ = std::make_unique<LiveLocaliser>(
        parameters_, std::move(store), std::move(map), [this] { return makeRetrieval(); },
        [this](const auto& estimate, const auto& T_map_odom) { publisher_->publish(estimate, T_map_odom); });
  } catch (const Error& error) {
    throw UserError(parameter, error.what(), "");
  }
}

std::shared_ptr<KeyframeRetrieval> LocalizationStage::makeRetrieval() {
  try {
    return plugins_.createUniqueInstance(kPlaceRecognition);
  } catch (const pluginlib::PluginlibException& error) {
    throw UserError(kPlaceRecognition, error.what(), "the package fabmap_node of the same installation");
  }
}

void LocalizationStage::subscribe() {
  subscribeRobot(node_, nodelet_.queue_size, nodelet_.stereo, nodelet_.compressed, parameters_.icp);
  urban_nav_ros::TopicOptions options;
  options.is_monitored = options.is_paused = false;
  options.queue = nodelet_.queue_size;
  node_.subscribe<nav_msgs::Odometry>(urban_nav_ros::topics::kOdometry, options, [this](const auto& message) {
    publisher_->sendTransform(urban_nav_ros::toStampNs(message->header.stamp));
  });
  node_.subscribe<geometry_msgs::PoseWithCovarianceStamped>(
      urban_nav_ros::topics::kInitialPose, options, [this](const auto& message) {
        try {
          node_.push(LiveLocaliser::InitialPose{
              urban_nav_ros::toStampNs(message->header.stamp),
              toInitialPose(*message, nodelet_.map_frame, urban_nav_ros::topics::kInitialPose, map_)});
        } catch (const Error& error) {
          ++initial_poses_refused_;
          node_.logError(error.what());
        }
      });
}

void LocalizationStage::handle(Input& input) {
  if (const auto* pose = std::get_if<LiveLocaliser::InitialPose>(&input)) return localiser_->addInitialPose(*pose);
  std::visit(
      [this](const auto& each) {
        if constexpr (!std::is_same_v<std::decay_t<decltype(each)>, LiveLocaliser::InitialPose>) inputs_->handle(each);
      },
      input);
}

bool LocalizationStage::idle() {
  inputs_->idle();
  const bool busy = localiser_->work();
  const urban_nav_live::StageReport now = report();
  node_.publishStatus(now.status, now.reason_name, urban_nav_ros::toStampNs(ros::Time::now()));
  const std::string fault = localiser_->state().map_fault;
  if (fault != map_fault_ && !fault.empty()) node_.logError(node_.privateHandle().resolveName("store") + ": " + fault);
  map_fault_ = fault;
  return busy;
}

urban_nav_live::StageReport LocalizationStage::report() const {
  StageState state;
  state.paused = node_.gate().isPaused();
  state.compares_images = nodelet_.stereo && has_keyframes_;
  state.localiser = localiser_->state();
  state.map = nodelet_.store;
  state.odometry_fault = node_.monitor().fault(urban_nav_ros::topic_groups::kOdometry);
  state.image_fault = node_.monitor().fault(urban_nav_ros::topic_groups::kImages);
  state.camera_fault = inputs_->sessions().fault();
  state.laser_pose_fault = inputs_->laserFault();
  state.camera = inputs_->mountingFault();
  state.initial_poses_refused = initial_poses_refused_;
  state.damaged_images = inputs_->sessions().counts().damaged;
  urban_nav_live::StageReport report = makeReport(state);
  inputs_->beams().addTo(report);
  return report;
}

class LocalizationNodelet : public urban_nav_ros::StageNodelet<LocalizationStage> {};

}  // namespace urban_nav_localization

PLUGINLIB_EXPORT_CLASS(urban_nav_localization::LocalizationNodelet, nodelet::Nodelet)
