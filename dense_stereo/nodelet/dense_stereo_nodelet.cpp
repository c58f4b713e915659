// SPDX-License-Identifier: BSD-3-Clause
#include <pluginlib/class_list_macros.hpp>

#include <tuple>

#include "live/live_stereo.hpp"
#include "live/nodelet_parameters.hpp"
#include "publisher.hpp"
#include "urban_nav_ros/accelerometer.hpp"
#include "urban_nav_ros/live_camera_turns.hpp"
#include "urban_nav_ros/stage_nodelet.hpp"
#include "urban_nav_ros/stereo_topics.hpp"

namespace dense_stereo {

using urban_nav_ros::StereoSessions;

namespace {

constexpr double kImageTimeout = 1.0;  // s

}  // namespace

/// Publishes dense stereo.
class DenseStereoStage {
 public:
  static constexpr const char* name = "dense_stereo";
  static constexpr const char* topic = "disparity";
  using Input = StereoSessions::Message;
  using Node = urban_nav_ros::StageNodeWith<Input>;

  explicit DenseStereoStage(Node& node);

  void handle(Input& input);
  bool idle() {
    sessions_->idle();
    return false;
  }
  std::string reset() {
    sessions_->end("reset");
    return "the session was ended; the next pair begins a new one";
  }
  void close() {
    if (ros::ok()) sessions_->end("shutdown");
  }
  urban_nav_live::StageReport report() const;

 private:
  void begin(const StereoSessions::Camera& camera);
  void process(urban_nav_ros::DecodedPair& pair);
  void refuse(const std::string& fault);

  Node& node_;
  NodeletParameters nodelet_;
  Parameters parameters_;
  std::unique_ptr<Publisher> publisher_;
  std::unique_ptr<LiveStereo> stereo_;
  std::unique_ptr<StereoSessions> sessions_;
  std::unique_ptr<urban_nav_ros::Accelerometer> accelerometer_;
  urban_nav_ros::LiveCameraTurns turns_;
};

DenseStereoStage::DenseStereoStage(Node& node) : node_(node) {
  std::tie(nodelet_, parameters_) = node.parameters(nodeletTable(), table());
  node.setQueueSize(nodelet_.queue_size, nodelet_.drain_s);
  publisher_ = std::make_unique<Publisher>(node, parameters_.keyframe_interval);
  stereo_ = std::make_unique<LiveStereo>(parameters_);
  accelerometer_ =
      std::make_unique<urban_nav_ros::Accelerometer>(nodelet_.base_frame, node.sensors().corrections().accelerometer);
  sessions_ = std::make_unique<StereoSessions>(
      urban_nav_ros::toStereoOptions(nodelet_, node.nh()),
      StereoSessions::Listener{[this](const auto& camera) { begin(camera); }, [this](auto& pair) { process(pair); },  //
                               [this](const auto& why) { stereo_->end(why); },
                               [this](const auto& fault) { refuse(fault); }});
  urban_nav_ros::TopicOptions options;
  options.timeout = kImageTimeout;
  options.queue = nodelet_.queue_size;
  subscribeStereo(node, options, nodelet_.compressed, urban_nav_core::MotionChoice());
  turns_.subscribe(node, nodelet_.queue_size);
  if (!nodelet_.gravity) return;
  urban_nav_ros::TopicOptions unmonitored;  // an IMU is optional
  unmonitored.is_monitored = false;
  node.subscribeInput<sensor_msgs::Imu>(urban_nav_ros::topics::kImu, unmonitored,
                                        [](const auto& message) { return Input(message); });
}

void DenseStereoStage::handle(Input& input) {
  if (const auto* imu = std::get_if<sensor_msgs::ImuConstPtr>(&input)) {
    for (const auto& sample : accelerometer_->add(**imu)) stereo_->addForce(sample);
    return;
  }
  if (const auto* transforms = std::get_if<tf2_msgs::TFMessageConstPtr>(&input))
    for (const auto& sample : accelerometer_->add(**transforms)) stereo_->addForce(sample);
  sessions_->handle(input);
}

void DenseStereoStage::refuse(const std::string& fault) {
  stereo_->setFault(fault);
  if (!fault.empty()) node_.logError(fault);
}

void DenseStereoStage::begin(const StereoSessions::Camera& camera) {
  stereo_->begin(camera.camera, camera.T_base_left, camera.is_mounting_known);
  turns_.begin(camera.camera);
  publisher_->startSession(camera.frame, camera.camera, parameters_.disparities);
  node_.logInfo("session " + std::to_string(stereo_->sessions()) + ": " + camera.sentence());
}

void DenseStereoStage::process(urban_nav_ros::DecodedPair& pair) {
  for (const std::string& fault : pair.faults) node_.logWarning("image", fault);
  if (!nodelet_.always && !publisher_->isWanted(pair.assembled.pair.stamp)) return stereo_->skip();
  turns_.correct(pair.assembled);
  publisher_->publish(stereo_->process(pair.assembled.pair), pair.assembled.pair);
}

urban_nav_live::StageReport DenseStereoStage::report() const {
  urban_nav_live::StageReport report = stereo_->report();
  report.warn(sessions_->placeFault());
  sessions_->counts().addTo(report);
  accelerometer_->addTo(report);
  return report;
}

class DenseStereoNodelet : public urban_nav_ros::StageNodelet<DenseStereoStage> {};

}  // namespace dense_stereo

PLUGINLIB_EXPORT_CLASS(dense_stereo::DenseStereoNodelet, nodelet::Nodelet)
