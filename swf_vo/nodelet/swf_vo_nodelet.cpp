// SPDX-License-Identifier: BSD-3-Clause
#include <nodelet/nodelet.h>
#include <ros/ros.h>
#include <tf2_msgs/TFMessage.h>
#include <pluginlib/class_list_macros.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <future>
#include <thread>
#include <tuple>

#include "diagnostics.hpp"
#include "publisher.hpp"
#include "session.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_ros/camera_info.hpp"
#include "urban_nav_ros/mailbox.hpp"
#include "urban_nav_ros/parameters.hpp"
#include "urban_nav_ros/stamp.hpp"
#include "urban_nav_ros/trigger.hpp"

namespace swf_vo {

using Clock = std::chrono::steady_clock;
using urban_nav_core::StampNs;
using urban_nav_core::UserError;
using urban_nav_ros::Side;
using urban_nav_ros::StereoCalibration;
using urban_nav_ros::toStampNs;

namespace {

struct InfoInput {
  Side side;
  sensor_msgs::CameraInfoConstPtr message;
};
struct Reset {
  std::shared_ptr<std::promise<void>> done;
};
using Input = std::variant<SensorInput, InfoInput, tf2_msgs::TFMessageConstPtr, Reset>;

// A queue of images takes this long to be worked off, at most; a caller of ~reset does not wait longer.
constexpr std::chrono::seconds reset_patience{10};

// A stamp that lies this far back is a bag that began again or a clock that was set, not a late message.
constexpr StampNs back_in_time = 1'000'000'000;

bool sameCalibration(const sensor_msgs::CameraInfo& a, const sensor_msgs::CameraInfo& b) {
  return a.width == b.width && a.height == b.height && a.D == b.D && a.K == b.K && a.R == b.R && a.P == b.P;
}

}  // namespace

/// Visual odometry on topics: callbacks enqueue, one worker converts, calls the core and
/// publishes.
class SwfVoNodelet : public nodelet::Nodelet {
 public:
  ~SwfVoNodelet() override {
    // First nobody may call any more; then the worker ends.
    subscribers_.clear();
    services_.clear();
    timer_.stop();
    mailbox_.close();
    if (worker_.joinable()) worker_.join();
  }

 private:
  void onInit() override;
  void subscribe();
  void advertiseServices();

  // In the callbacks' threads.
  void put(Diagnostics::Topic topic, StampNs stamp, Input input);
  template <typename Message>
  void subscribeImage(const std::string& name, Side side, Diagnostics::Topic topic);
  void subscribeInfo(const std::string& name, Side side, Diagnostics::Topic topic);

  // In the worker's thread.
  void work();
  void take(Input& input);
  void takeInfo(const InfoInput& info);
  void tryToStart();
  void start();
  void processReadyPairs();
  void endSession(const char* why);
  Counts countsOf(const Session& session) const;

  Parameters parameters_;
  NodeletParameters nodelet_;
  bool rectified_ = false;
  std::vector<ros::Subscriber> subscribers_;
  std::vector<ros::ServiceServer> services_;
  ros::WallTimer timer_;
  std::unique_ptr<Publisher> publisher_;
  std::unique_ptr<Diagnostics> diagnostics_;
  urban_nav_ros::Mailbox<Input> mailbox_;
  std::atomic<bool> paused_{false};
  std::atomic<std::int64_t> paused_dropped_{0};
  std::thread worker_;

  // The worker's own.
  urban_nav_ros::StaticTransforms transforms_;
  sensor_msgs::CameraInfoConstPtr left_info_, right_info_;
  std::string imu_frame_ = "imu_link";
  std::deque<SensorInput> before_session_;
  std::optional<Clock::time_point> first_image_;
  std::optional<StampNs> newest_;
  std::string refusal_;  // why these camera_info make no session; said once
  std::unique_ptr<Session> session_;
  Counts finished_;  // of the sessions before
  std::int64_t pending_dropped_ = 0;
};

void SwfVoNodelet::onInit() {
  try {
    std::tie(nodelet_, parameters_) = urban_nav_ros::readParameters(getPrivateNodeHandle(), nodeletTable(), table());
  } catch (const UserError& error) {
    NODELET_FATAL("%s", error.what());
    throw;
  }
  mailbox_.setCapacity(static_cast<std::size_t>(nodelet_.queue));
  publisher_ = std::make_unique<Publisher>(getNodeHandle());
  diagnostics_ = std::make_unique<Diagnostics>(getNodeHandle(), getPrivateNodeHandle(), getName());
  worker_ = std::thread([this] { work(); });
  subscribe();
  advertiseServices();
  timer_ = getNodeHandle().createWallTimer(ros::WallDuration(1.0),
                                           [this](const ros::WallTimerEvent&) { diagnostics_->update(); });
}

void SwfVoNodelet::subscribe() {
  ros::NodeHandle& nh = getNodeHandle();
  const std::string left = "stereo/left/image_raw", right = "stereo/right/image_raw";
  rectified_ = urban_nav_ros::areRectified(nodelet_.images, nh.resolveName(left));
  subscribers_.push_back(nh.subscribe<tf2_msgs::TFMessage>(
      "/tf_static", 100, [this](const tf2_msgs::TFMessageConstPtr& message) { mailbox_.put(message); }));
  subscribeInfo("stereo/left/camera_info", Side::Left, Diagnostics::LeftInfo);
  subscribeInfo("stereo/right/camera_info", Side::Right, Diagnostics::RightInfo);
  if (nodelet_.compressed) {
    subscribeImage<sensor_msgs::CompressedImage>(left, Side::Left, Diagnostics::LeftImage);
    subscribeImage<sensor_msgs::CompressedImage>(right, Side::Right, Diagnostics::RightImage);
  } else {
    subscribeImage<sensor_msgs::Image>(left, Side::Left, Diagnostics::LeftImage);
    subscribeImage<sensor_msgs::Image>(right, Side::Right, Diagnostics::RightImage);
  }
  const auto queue = static_cast<std::uint32_t>(nodelet_.queue);
  if (parameters_.motion_input == "wheels") {
    diagnostics_->expect(Diagnostics::Motion, nh.resolveName("wheel_odom"));
    subscribers_.push_back(
        nh.subscribe<nav_msgs::Odometry>("wheel_odom", queue, [this](const nav_msgs::OdometryConstPtr& message) {
          put(Diagnostics::Motion, toStampNs(message->header.stamp), SensorInput(message));
        }));
  } else if (parameters_.motion_input == "gyroscope") {
    diagnostics_->expect(Diagnostics::Motion, nh.resolveName("imu/data"));
    subscribers_.push_back(
        nh.subscribe<sensor_msgs::Imu>("imu/data", queue, [this](const sensor_msgs::ImuConstPtr& message) {
          put(Diagnostics::Motion, toStampNs(message->header.stamp), SensorInput(message));
        }));
  }
}

template <typename Message>
void SwfVoNodelet::subscribeImage(const std::string& name, Side side, Diagnostics::Topic topic) {
  diagnostics_->expect(topic, getNodeHandle().resolveName(name));
  const auto callback = [this, side, topic](const boost::shared_ptr<const Message>& message) {
    const StampNs stamp = toStampNs(message->header.stamp);
    put(topic, stamp, SensorInput(ImageInput{side, message, stamp}));
  };
  subscribers_.push_back(
      getNodeHandle().subscribe<Message>(name, static_cast<std::uint32_t>(nodelet_.queue), callback));
}

void SwfVoNodelet::subscribeInfo(const std::string& name, Side side, Diagnostics::Topic topic) {
  diagnostics_->expect(topic, getNodeHandle().resolveName(name));
  subscribers_.push_back(getNodeHandle().subscribe<sensor_msgs::CameraInfo>(
      name, 10, [this, side, topic](const sensor_msgs::CameraInfoConstPtr& message) {
        put(topic, toStampNs(message->header.stamp), InfoInput{side, message});
      }));
}

void SwfVoNodelet::advertiseServices() {
  const auto advertise = [this](const char* name, const std::function<std::string()>& action) {
    services_.push_back(urban_nav_ros::advertiseTrigger(getPrivateNodeHandle(), name, action));
  };
  advertise("reset", [this] {
    const auto done = std::make_shared<std::promise<void>>();
    mailbox_.put(Reset{done});
    const bool ended = done->get_future().wait_for(reset_patience) == std::future_status::ready;
    return ended ? "the session has ended, the next pair begins a new one" : "";
  });
  advertise("pause", [this] {
    paused_ = true;
    diagnostics_->paused(true);
    return "inputs are dropped until resume";
  });
  advertise("resume", [this] {
    paused_ = false;
    diagnostics_->paused(false);
    return "the session goes on";
  });
}

void SwfVoNodelet::put(Diagnostics::Topic topic, StampNs stamp, Input input) {
  diagnostics_->received(topic, stamp);
  if (paused_) ++paused_dropped_;
  else mailbox_.put(std::move(input));
}

void SwfVoNodelet::work() {
  while (!mailbox_.closed()) {
    for (Input& input : mailbox_.takeAll(std::chrono::milliseconds(100))) {
      take(input);
      if (!session_) tryToStart();
      if (session_) processReadyPairs();
      if (mailbox_.closed()) break;
    }
    if (!session_) tryToStart();
  }
  endSession("shutdown");
}

void SwfVoNodelet::take(Input& input) {
  if (const auto* info = std::get_if<InfoInput>(&input)) return takeInfo(*info);
  if (const auto* transforms = std::get_if<tf2_msgs::TFMessageConstPtr>(&input)) return transforms_.add(**transforms);
  if (const auto* reset = std::get_if<Reset>(&input)) {
    endSession("reset");
    return reset->done->set_value();
  }
  auto& sensor = std::get<SensorInput>(input);
  if (const auto* image = std::get_if<ImageInput>(&sensor)) {
    if (newest_ && image->stamp < *newest_ - back_in_time) endSession("time went back");
    newest_ = newest_ ? std::max(*newest_, image->stamp) : image->stamp;
    if (!first_image_) first_image_ = Clock::now();
  }
  if (const auto* imu = std::get_if<sensor_msgs::ImuConstPtr>(&sensor)) imu_frame_ = (*imu)->header.frame_id;
  if (session_) return session_->add(sensor);
  before_session_.push_back(std::move(sensor));
  if (before_session_.size() <= static_cast<std::size_t>(nodelet_.queue)) return;
  before_session_.pop_front();
  ++pending_dropped_;
}

void SwfVoNodelet::takeInfo(const InfoInput& info) {
  sensor_msgs::CameraInfoConstPtr& known = info.side == Side::Left ? left_info_ : right_info_;
  if (known && sameCalibration(*known, *info.message)) return;
  if (session_) endSession("the calibration changed");
  // A new left camera with the old right one would be neither: the other side has to speak again.
  if (known) (info.side == Side::Left ? right_info_ : left_info_).reset();
  known = info.message;
  refusal_.clear();
}

void SwfVoNodelet::tryToStart() {
  if (!first_image_ || !left_info_ || !right_info_ || !refusal_.empty()) return;
  const bool placed = transforms_.lookup(nodelet_.base_frame, left_info_->header.frame_id).has_value();
  if (!placed && Clock::now() - *first_image_ < std::chrono::duration<double>(nodelet_.tf_wait)) return;
  try {
    start();
  } catch (const UserError& error) {
    refusal_ = error.what();
    NODELET_ERROR("%s", error.what());
    diagnostics_->waiting(refusal_);
  }
}

void SwfVoNodelet::start() {
  const auto calibration = std::make_shared<StereoCalibration>(urban_nav_ros::toCameraInfo(*left_info_),
                                                               urban_nav_ros::toCameraInfo(*right_info_), rectified_,
                                                               getNodeHandle().resolveName("stereo"));
  const std::string& camera_frame = left_info_->header.frame_id;
  const Mounting mounting = mountingOf(transforms_, nodelet_.base_frame, camera_frame, imu_frame_);
  session_ = std::make_unique<Session>(parameters_, nodelet_, calibration, mounting);
  publisher_->startSession({nodelet_.odom_frame, nodelet_.base_frame, camera_frame, nodelet_.publish_tf},
                           0.1 * calibration->camera().left.width);
  diagnostics_->waiting("");
  ++finished_.sessions;
  NODELET_INFO("session %ld: %dx%d px, %s; %s", static_cast<long>(finished_.sessions), calibration->camera().left.width,
               calibration->camera().left.height, calibration->rectifies() ? "rectified here" : "rectified already",
               mounting.sentence.c_str());
  for (const SensorInput& input : std::exchange(before_session_, {})) session_->add(input);
}

void SwfVoNodelet::processReadyPairs() {
  while (auto pair = session_->take()) {
    for (const std::string& fault : pair->faults) NODELET_WARN_THROTTLE(5.0, "%s", fault.c_str());
    finished_.damaged += static_cast<std::int64_t>(pair->faults.size());
    const Clock::time_point begin = Clock::now();
    const Frame& frame = session_->process(pair->assembled);
    const double ms = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
    ++finished_.frames;
    publisher_->publish(frame, pair->assembled.pair, ms);
    diagnostics_->worked(frame, ms, countsOf(*session_));
  }
}

void SwfVoNodelet::endSession(const char* why) {
  newest_.reset();
  first_image_.reset();
  before_session_.clear();
  if (!session_) return;
  if (ros::ok()) {
    session_->finish();
    processReadyPairs();
    for (const Settled& settled : session_->flush()) publisher_->publish(settled);
  }
  finished_ = countsOf(*session_);
  session_.reset();
  NODELET_INFO("session %ld ended: %s", static_cast<long>(finished_.sessions), why);
  diagnostics_->waiting(std::string("no session (") + why + ")");
}

Counts SwfVoNodelet::countsOf(const Session& session) const {
  Counts counts = finished_;
  counts.queue_dropped = mailbox_.dropped() + pending_dropped_;
  counts.paused_dropped = paused_dropped_;
  for (const Side side : {Side::Left, Side::Right}) {
    counts.late += session.feed().counts(side).late;
    counts.doubled += session.feed().counts(side).doubled;
  }
  counts.left_missing += session.feed().missing(Side::Left);
  counts.right_missing += session.feed().missing(Side::Right);
  return counts;
}

}  // namespace swf_vo

PLUGINLIB_EXPORT_CLASS(swf_vo::SwfVoNodelet, nodelet::Nodelet)
