// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/service_server.h>
#include <ros/subscriber.h>
#include <urban_nav_msgs/StageStatus.h>

#include <boost/function.hpp>
#include <chrono>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "urban_nav_core/types/error.hpp"
#include "urban_nav_core/types/status.hpp"
#include "urban_nav_live/fault_rates.hpp"
#include "urban_nav_live/input_gate.hpp"
#include "urban_nav_live/stage_report.hpp"
#include "urban_nav_live/store_writer_link.hpp"
#include "urban_nav_live/topic_monitor.hpp"
#include "urban_nav_live/worker_loop.hpp"
#include "urban_nav_ros/parameters.hpp"
#include "urban_nav_ros/sensor_inputs.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_ros {

/// Subscription of a stage.
struct TopicOptions {
  double timeout = urban_nav_live::TopicMonitor::kNoTimeout;  ///< s without a message after which the topic is silent
  std::string group;                                          ///< of urban_nav_live::TopicMonitor
  bool is_monitored = true;                                   ///< false: messages on the topic are optional
  bool is_paused = true;  ///< messages are dropped during a pause; false for odometry, which must not have a gap
  int queue = 100;        ///< messages
  /// After an interrupt, wait for messages on this topic, which may come from the window of an earlier stage.
  bool is_awaited = false;
};

/// ROS side of a live stage apart from its topics: handles, monitored subscriptions, services, the latched status
/// topic, /diagnostics and the log. Thread-safe after the stage's constructor.
class StageNode {
 public:
  struct Handles {
    ros::NodeHandle nh, private_nh;
    ros::NodeHandle service_nh;  ///< private, served by several threads: a blocking service delays no message
    std::string name;            ///< of the nodelet
  };
  /// `stage`: name, before "/status". `topic`: product of the stage, the title of its diagnostics. Throws UserError for
  /// parameters of SensorInputs.
  StageNode(Handles handles, const std::string& stage, const std::string& topic);
  StageNode(const StageNode&) = delete;
  StageNode& operator=(const StageNode&) = delete;

  ros::NodeHandle& nh() { return handles_.nh; }
  ros::NodeHandle& privateHandle() { return handles_.private_nh; }
  const std::string& name() const { return handles_.name; }
  urban_nav_live::TopicMonitor& monitor() { return monitor_; }
  urban_nav_live::InputGate& gate() { return gate_; }
  /// Returns the corrections applied to the messages of subscribe(), except for that of the accelerometer.
  const SensorInputs& sensors() const { return sensors_; }

  /// Returns the parameters of the nodelet and of its stage from the private namespace. Throws UserError.
  template <typename Own, typename Stage>
  std::pair<Own, Stage> parameters(const urban_nav_core::Table<Own>& own, const urban_nav_core::Table<Stage>& stage) {
    return readParameters(handles_.private_nh, own, stage);
  }

  /// Subscribes to a topic. `callback`: called in a thread of ROS with each message that is not dropped by a pause,
  /// corrected by the parameters `input/...`.
  template <typename Message>
  void subscribe(const std::string& topic, const TopicOptions& options,
                 const std::function<void(const boost::shared_ptr<const Message>&)>& callback);

  /// Advertises a private service whose response has `success` and `message`. `action` fills in the response in a
  /// thread of ROS; an Error thrown by it becomes the message of a failure.
  template <typename Service>
  void advertiseService(
      const std::string& name,
      const std::function<void(const typename Service::Request&, typename Service::Response&)>& action);

  /// Publishes `<stage>/status`, latched, if health or reason has changed.
  void publishStatus(const urban_nav_core::Status& status, const std::string& reason_name,
                     urban_nav_core::StampNs stamp);
  /// Publishes the next status even if it has not changed.
  void restartStatus();
  /// Sets the report that update() publishes. `dropped`: inputs dropped from a full queue; `pushed`: all inputs.
  void setReport(urban_nav_live::StageReport report, std::int64_t dropped, std::int64_t pushed);
  /// Publishes /diagnostics.
  void update() { updater_.force_update(); }

  void logInfo(const std::string& text) const;
  void logError(const std::string& text) const;
  /// Logs the fault of a store when it changes, and when the store is writable again. Returns whether it changed. Must
  /// be called by one thread.
  bool followStore(const urban_nav_live::StoreState& state);
  /// Logs a warning, at most one in five seconds per `key`.
  void logWarning(const std::string& key, const std::string& text);

  /// Sets and returns the time within which an interrupted stage must end.
  void setDrainTime(double seconds) { drain_ = std::chrono::milliseconds(static_cast<int>(1e3 * seconds)); }
  std::chrono::milliseconds drainTime() const { return drain_; }
  /// Waits until no other process publishes the awaited topics and no message has been received for a moment, at most
  /// until `end`.
  void awaitInputs(std::chrono::steady_clock::time_point end) const;

  /// Ends a subscription. Called by the stage.
  void unsubscribe(const std::string& topic);
  /// Ends subscriptions and services: no callback runs afterwards.
  void shutDown();

 private:
  using Clock = std::chrono::steady_clock;
  void fill(diagnostic_updater::DiagnosticStatusWrapper& status) const;

  Handles handles_;
  const std::string stage_;
  const SensorInputs sensors_;
  urban_nav_live::TopicMonitor monitor_;
  urban_nav_live::InputGate gate_;
  std::mutex subscribers_mutex_;  // guards subscribers_
  std::vector<ros::Subscriber> subscribers_, awaited_;
  std::chrono::milliseconds drain_{5000};
  std::vector<ros::ServiceServer> services_;
  ros::Publisher status_publisher_;
  std::string store_fault_;  // used by the thread that calls followStore()

  mutable std::mutex mutex_;  // guards all members below except updater_
  std::optional<urban_nav_msgs::StageStatus> last_status_;
  urban_nav_live::StageReport report_;
  std::int64_t dropped_ = 0, pushed_ = 0;
  mutable urban_nav_live::FaultRates rates_;  // updated when the report is published
  std::map<std::string, Clock::time_point> warned_;
  diagnostic_updater::Updater updater_;
};

/// StageNode with the queue of the stage's worker. Thread-safe after the stage's constructor.
template <typename Input>
class StageNodeWith : public StageNode {
 public:
  using StageNode::StageNode;

  /// Sets the capacity of the worker's queue, inputs, and the time, s, within which an interrupted stage must end.
  void setQueueSize(int inputs, double drain_s) {
    loop_.setCapacity(static_cast<std::size_t>(inputs));
    setDrainTime(drain_s);
  }
  void push(Input input) { loop_.push(std::move(input)); }
  /// Subscribes and queues the result of `convert` for each message: an Input, or an optional one. A message for which
  /// it is empty is counted as invalid, with a warning.
  template <typename Message, typename Convert>
  void subscribeInput(const std::string& topic, const TopicOptions& options, const Convert& convert);

  /// Evaluates `question` in the worker's thread after all earlier inputs, and returns its result. Rethrows its
  /// exceptions. Throws UserError if it is not evaluated within `timeout`. Requires that the caller is not the worker.
  template <typename Question>
  auto ask(const Question& question, std::chrono::milliseconds timeout = std::chrono::seconds(30))
      -> decltype(question()) {
    auto answer = loop_.ask(question, timeout);
    if (!answer) throw urban_nav_core::UserError("", "busy with earlier inputs; try again", "");
    return std::move(*answer);
  }
  urban_nav_live::WorkerLoop<Input>& loop() { return loop_; }

 private:
  template <typename Value>
  static std::optional<Input> toInput(std::optional<Value> value) {
    if (!value) return std::nullopt;
    return Input(std::move(*value));
  }
  template <typename Value>
  static std::optional<Input> toInput(Value value) {
    return Input(std::move(value));
  }

  urban_nav_live::WorkerLoop<Input> loop_;
};

template <typename Message>
void StageNode::subscribe(const std::string& topic, const TopicOptions& options,
                          const std::function<void(const boost::shared_ptr<const Message>&)>& callback) {
  const std::string name = handles_.nh.resolveName(topic);
  if (options.is_monitored) monitor_.expect(name, options.timeout, options.group);
  const boost::function<void(const boost::shared_ptr<const Message>&)> received =
      [this, name, topic, callback, is_paused = options.is_paused](const boost::shared_ptr<const Message>& original) {
        const boost::shared_ptr<const Message> message = sensors_.correct(topic, original);
        if (!message) return gate_.countInvalid();
        urban_nav_core::StampNs stamp = 0;
        if constexpr (ros::message_traits::HasHeader<Message>::value) stamp = toStampNs(message->header.stamp);
        monitor_.received(name, stamp);
        if (!is_paused) gate_.countReceived();
        if (!is_paused || gate_.pass()) callback(message);
      };
  const std::lock_guard<std::mutex> lock(subscribers_mutex_);
  subscribers_.push_back(handles_.nh.subscribe<Message>(topic, static_cast<std::uint32_t>(options.queue), received));
  if (options.is_awaited) awaited_.push_back(subscribers_.back());
}

template <typename Service>
void StageNode::advertiseService(
    const std::string& name,
    const std::function<void(const typename Service::Request&, typename Service::Response&)>& action) {
  using Request = typename Service::Request;
  using Response = typename Service::Response;
  const boost::function<bool(Request&, Response&)> callback = [action](Request& request, Response& response) {
    try {
      response.success = true;
      action(request, response);
    } catch (const urban_nav_core::Error& error) {
      response = Response();
      response.message = error.what();
    }
    return true;
  };
  services_.push_back(handles_.service_nh.advertiseService(name, callback));
}

template <typename Input>
template <typename Message, typename Convert>
void StageNodeWith<Input>::subscribeInput(const std::string& topic, const TopicOptions& options,
                                          const Convert& convert) {
  subscribe<Message>(topic, options, [this, topic, convert](const boost::shared_ptr<const Message>& message) {
    if (std::optional<Input> input = toInput(convert(message))) return push(std::move(*input));
    gate().countInvalid();
    logWarning(topic, topic + ": invalid message: not finite, an invalid pose, or an unknown enumerator");
  });
}

}  // namespace urban_nav_ros
