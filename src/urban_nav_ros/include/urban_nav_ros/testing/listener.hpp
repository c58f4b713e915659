// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "urban_nav_ros/testing/crash_trace.hpp"  // of every test of a nodelet

namespace urban_nav_ros::testing {

/// Subscriber in the rostest of a nodelet: keeps all messages on the given topics, in the thread of the test.
class Listener {
 public:
  /// `node`: the nodelet's name, under which its services are.
  explicit Listener(std::string node) : node_(std::move(node)) { keep("/diagnostics", diagnostics); }

  /// Spins until the condition holds; false after five minutes, which is sufficient on a busy machine.
  static bool until(const std::function<bool()>& so) {
    const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(300.0);
    while (ros::ok() && ros::WallTime::now() < end) {
      ros::spinOnce();
      if (so()) return true;
      ros::WallDuration(0.01).sleep();
    }
    return false;
  }

  /// Returns whether each stored topic has a publisher, and each of the test's own topics a subscriber.
  bool isConnected() const {
    return std::all_of(subscribers_.begin(), subscribers_.end(),
                       [](const ros::Subscriber& each) { return each.getNumPublishers() > 0; }) &&
           std::all_of(publishers_.begin(), publishers_.end(),
                       [](const ros::Publisher& each) { return each.getNumSubscribers() > 0; });
  }

  /// Calls a service without arguments; returns its `success`.
  bool call(const std::string& service) {
    std_srvs::Trigger trigger;
    return ros::service::call(node_ + "/" + service, trigger) && trigger.response.success;
  }

  /// Returns whether any status had this entry.
  bool diagnosed(const std::string& key, const std::string& value) const {
    for (const auto& array : diagnostics)
      for (const auto& status : array.status)
        for (const auto& entry : status.values)
          if (entry.key == key && entry.value == value) return true;
    return false;
  }

  std::vector<diagnostic_msgs::DiagnosticArray> diagnostics;

 protected:
  template <typename Message>
  void keep(const std::string& topic, std::vector<Message>& into) {
    const boost::function<void(const boost::shared_ptr<const Message>&)> callback =
        [&into](const boost::shared_ptr<const Message>& message) { into.push_back(*message); };
    subscribers_.push_back(nh_.subscribe<Message>(topic, 1000, callback));
  }
  template <typename Message>
  ros::Publisher advertise(const std::string& topic, bool latched = false) {
    publishers_.push_back(nh_.advertise<Message>(topic, 1000, latched));
    return publishers_.back();
  }

 private:
  const std::string node_;
  ros::NodeHandle nh_;
  std::vector<ros::Subscriber> subscribers_;
  std::vector<ros::Publisher> publishers_;
};

}  // namespace urban_nav_ros::testing
