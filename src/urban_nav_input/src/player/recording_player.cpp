// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/player/recording_player.hpp"

#include <ros/ros.h>
#include <rosgraph_msgs/Clock.h>
#include <std_srvs/SetBool.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "recording/message/ros1_form.hpp"
#include "recording/message/serialized_message.hpp"
#include "urban_nav_core/io/printable.hpp"
#include "urban_nav_input/player/playback_clock.hpp"
#include "urban_nav_input/recording/recording.hpp"
#include "urban_nav_ros/stamp.hpp"
#include "urban_nav_ros/topics.hpp"

namespace urban_nav_input {

using std::chrono::steady_clock;
using urban_nav_core::printable;
using urban_nav_core::StampNs;

namespace {

constexpr std::uint32_t kQueue = 100;                                  // messages for each subscriber
constexpr std::chrono::milliseconds kClockPeriod(10), kMostSleep(10);  // period of serving services
constexpr double kLastMessages = 0.5;                                  // s for subscribers to receive them

class RecordingPlayer {
 public:
  explicit RecordingPlayer(const PlayerOptions& options)
      : options_(options), recording_(options.path), is_paused_(options.paused) {
    const StampNs begin = recording_.begin();
    begin_ = begin + static_cast<StampNs>(std::llround(1e9 * options_.start));
    for (const Connection& connection : recording_.connections()) advertise(connection);
    if (options_.clock) clock_ = node_.advertise<rosgraph_msgs::Clock>(urban_nav_ros::topics::kClock, 1);
    pause_ = private_node_.advertiseService("pause_playback", &RecordingPlayer::pause, this);
  }

  void run() {
    ros::WallDuration(options_.delay).sleep();
    bool any = false;
    do {
      any = playOnce();
    } while (any && options_.loop && ros::ok());
    if (!any) ROS_WARN("%s: no message later than %g s", options_.path.c_str(), options_.start);
    for (const std::string& warning : recording_.warnings())
      ROS_WARN("%s: %s", options_.path.c_str(), printable(warning).c_str());
    if (ros::ok()) ros::WallDuration(kLastMessages).sleep();
  }

 private:
  struct Topic {
    Ros1Form form;
    ros::Publisher publisher;
    bool is_latched = false;
  };
  using Key = std::pair<std::string, std::string>;  // topic and type

  void advertise(const Connection& connection) {
    const Key key{connection.topic, connection.type};
    if (topics_.count(key) > 0 || refused_.count(key) > 0) return;
    try {
      Topic topic{Ros1Form(connection), {}, connection.is_latched};
      // rosbag2 stores the durability of topics in a version-dependent form; this topic is always latched.
      topic.is_latched = topic.is_latched || connection.topic == urban_nav_ros::topics::kStaticTransforms;
      ros::AdvertiseOptions about(connection.topic, kQueue, topic.form.connection().md5, connection.type,
                                  topic.form.connection().definition);
      about.latch = topic.is_latched;
      topic.publisher = node_.advertise(about);
      topics_.emplace(key, std::move(topic));
    } catch (const std::invalid_argument& error) {
      refused_.insert(key);
      ROS_WARN("%s is left out: %s", printable(connection.topic).c_str(), printable(error.what()).c_str());
    }
  }

  void publish(const RecordedMessage& message) {
    const auto topic = topics_.find({message.connection().topic, message.connection().type});
    const ByteView bytes = topic == topics_.end() ? ByteView{} : message.bytes();
    if (bytes.data == nullptr) return;
    try {
      Ros1Form& form = topic->second.form;
      topic->second.publisher.publish(SerializedMessage{&form.connection(), form.convert(bytes)});
    } catch (const std::runtime_error& error) {
      ROS_WARN_THROTTLE(10.0, "%s: %s", printable(message.topic()).c_str(), printable(error.what()).c_str());
    }
  }

  /// Publishes the last message of each latched topic before the beginning.
  void publishLatched() {
    std::vector<std::string> latched;
    for (const auto& [key, topic] : topics_)
      if (topic.is_latched) latched.push_back(key.first);
    if (options_.start <= 0.0 || latched.empty()) return;
    std::map<std::string, RecordedMessage> last;
    MessageSelection before = recording_.select(latched, {0, begin_});
    while (const std::optional<RecordedMessage> message = before.next())
      last.insert_or_assign(message->topic(), *message);
    for (const auto& [topic, message] : last) publish(message);
  }

  /// Returns whether there are messages.
  bool playOnce() {
    MessageSelection messages = recording_.select(std::nullopt, {begin_, 0});
    PlaybackClock clock(begin_, options_.rate, steady_clock::now(), is_paused_);
    steady_clock::time_point tick = steady_clock::now();
    publishLatched();
    std::optional<RecordedMessage> next = messages.next();
    while (next && ros::ok()) {
      const steady_clock::time_point now = steady_clock::now(), due = clock.due(next->receipt());
      if (now >= tick) {
        publishClock(std::min(clock.at(now), next->receipt()));
        tick = std::max(tick + kClockPeriod, now);
      }
      if (now >= due) {
        publish(*next);
        next = messages.next();
      } else {
        std::this_thread::sleep_until(std::min({due, tick, now + kMostSleep}));
      }
      ros::spinOnce();
      clock.pause(is_paused_, steady_clock::now());
    }
    return messages.size() > 0;
  }

  void publishClock(StampNs time) {
    if (!options_.clock) return;
    rosgraph_msgs::Clock message;
    message.clock = urban_nav_ros::toRosTime(std::max(time, recording_.begin()));
    clock_.publish(message);
  }

  bool pause(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response) {
    response.success = request.data != static_cast<unsigned char>(is_paused_);
    is_paused_ = request.data != 0;
    response.message =
        std::string("Playback is ") + (response.success ? "now " : "already ") + (is_paused_ ? "paused" : "resumed");
    return true;
  }

  const PlayerOptions options_;
  Recording recording_;
  bool is_paused_;
  StampNs begin_ = 0;  // receipt at which playback begins
  std::map<Key, Topic> topics_;
  std::set<Key> refused_;
  ros::NodeHandle node_, private_node_{"~"};
  ros::Publisher clock_;
  ros::ServiceServer pause_;
};

}  // namespace

void playRecording(const PlayerOptions& options) { RecordingPlayer(options).run(); }

}  // namespace urban_nav_input
