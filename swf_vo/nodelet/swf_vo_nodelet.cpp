// SPDX-License-Identifier: BSD-3-Clause
#include <pluginlib/class_list_macros.hpp>

#include <tuple>

#include "live/live_odometry.hpp"
#include "live/nodelet_parameters.hpp"
#include "publisher.hpp"
#include "urban_nav_ros/stage_nodelet.hpp"
#include "urban_nav_ros/stereo_topics.hpp"

namespace swf_vo {

using urban_nav_ros::StereoSessions;

namespace {
constexpr double kImageTimeout = 1.0;  // s; the slowest cameras that odometry can use have 5 Hz
}  // namespace

/// Visual odometry on topics.
class SwfVoStage {
 public:
  static constexpr const char* name = "swf_vo";
  static constexpr const char* topic = "odometry";
  using Input = StereoSessions::Message;
  using Node = urban_nav_ros::StageNodeWith<Input>;

  explicit SwfVoStage(Node& node);

  void handle(Input& input) { sessions_->handle(input); }
  bool idle() {
    sessions_->idle();
    return false;
  }
  std::string reset() {
    sessions_->end(LiveOdometry::kReset);
    return "session ended; the next pair begins a new one";
  }
  void finish(std::chrono::milliseconds /*limit*/) { sessions_->end(LiveOdometry::kFinished); }
  static constexpr int kFinishOrder = 0;  // the other stages receive the flushed poses
  void close() {
    if (ros::ok()) sessions_->end(LiveOdometry::kFinished);
  }
  urban_nav_live::StageReport report() const;

 private:
  void begin(const StereoSessions::Camera& camera);
  void process(urban_nav_ros::DecodedPair& pair);
  void end(const std::string& why);
  void refuse(const std::string& fault);

  Node& node_;
  NodeletParameters nodelet_;
  Parameters parameters_;
  std::unique_ptr<Publisher> publisher_;
  std::unique_ptr<LiveOdometry> odometry_;
  std::unique_ptr<StereoSessions> sessions_;
};

SwfVoStage::SwfVoStage(Node& node) : node_(node) {
  std::tie(nodelet_, parameters_) = node.parameters(nodeletTable(), table());
  node.setQueueSize(nodelet_.queue_size, nodelet_.drain_s);
  publisher_ = std::make_unique<Publisher>(node, nodelet_.imu_rate);
  LiveOdometry::Listener listener;
  listener.frame = [this](const Frame& frame, const urban_nav_core::StereoPair& pair, double process_ms) {
    publisher_->publish(frame, odometry_->session(), pair, process_ms);
    node_.monitor().setIncomplete(frame.status.reason == static_cast<int>(Reason::ImageMissing));
  };
  listener.warning = [this](const std::string& text) { node_.logWarning("motion sensor", text); };
  listener.settled = [this](const Settled& settled) { publisher_->publish(settled, odometry_->session()); };
  if (nodelet_.imu_rate) listener.propagated = [this](const PropagatedPose& pose) { publisher_->publish(pose); };
  odometry_ = std::make_unique<LiveOdometry>(parameters_, listener, nodelet_.robot, nodelet_.recording);
  StereoSessions::Options sessions = urban_nav_ros::toStereoOptions(nodelet_, node.nh());
  sessions.motion = urban_nav_core::toMotionChoice(nodelet_.motion_input);
  sessions.wheel_noise = nodelet_.wheel_noise;
  sessions.gyro_noise = nodelet_.gyro_noise;
  StereoSessions::Listener images;
  images.began = [this](const auto& camera) { begin(camera); };
  images.pair = [this](auto& pair) { process(pair); };
  images.ended = [this](const auto& why) { end(why); };
  images.refused = [this](const auto& fault) { refuse(fault); };
  images.motion = [this](const auto& input) { odometry_->addMotion(input); };
  sessions_ = std::make_unique<StereoSessions>(sessions, images);
  urban_nav_ros::TopicOptions options;
  options.timeout = kImageTimeout;
  options.queue = nodelet_.queue_size;
  subscribeStereo(node, options, nodelet_.compressed, sessions.motion);
}

void SwfVoStage::refuse(const std::string& fault) {
  odometry_->setFault(fault);
  if (!fault.empty()) node_.logError(fault);
}

void SwfVoStage::begin(const StereoSessions::Camera& camera) {
  odometry_->begin(camera.camera, camera.T_base_left);
  publisher_->startSession({nodelet_.odom_frame, nodelet_.base_frame, camera.frame, nodelet_.publish_tf},
                           0.1 * camera.camera.left.width);
  node_.logInfo("session " + std::to_string(odometry_->sessions()) + ": " + camera.sentence());
}

void SwfVoStage::process(urban_nav_ros::DecodedPair& pair) {
  for (const std::string& fault : pair.faults) node_.logWarning("image", fault);
  odometry_->process(pair.assembled, node_.loop().backlog());
}

void SwfVoStage::end(const std::string& why) {
  odometry_->end(why);
  node_.logInfo("session " + std::to_string(odometry_->sessions()) + " ended: " + why);
}

urban_nav_live::StageReport SwfVoStage::report() const {
  urban_nav_live::StageReport report = odometry_->report();
  report.warn(sessions_->placeFault());
  sessions_->counts().addTo(report);
  return report;
}

class SwfVoNodelet : public urban_nav_ros::StageNodelet<SwfVoStage> {};

}  // namespace swf_vo

PLUGINLIB_EXPORT_CLASS(swf_vo::SwfVoNodelet, nodelet::Nodelet)
