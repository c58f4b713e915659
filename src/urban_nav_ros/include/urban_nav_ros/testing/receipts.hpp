// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/master.h>
#include <ros/names.h>
#include <ros/network.h>
#include <ros/this_node.h>
#include <xmlrpcpp/XmlRpc.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <string>

#include "urban_nav_ros/testing/listener.hpp"

namespace urban_nav_ros::testing {

/// Messages that a node has received, by the statistics of its slave API. Each topic has a connection of its own, and
/// messages on different connections may overtake each other by as much as the machine is slow. What has been received
/// is handled before all that is published later, whatever its topic.
class Receipts {
 public:
  /// Messages to wait for, by topic.
  using Messages = std::map<std::string, int>;

  explicit Receipts(const std::string& node) : node_(ros::names::resolve(node)) {}

  /// Calls `publish`, and waits until the node has received that many messages more on each topic. Topics to which it
  /// is not connected are left out. Returns false after a minute. Requires that no earlier message on these topics is
  /// in flight.
  bool await(const Messages& messages, const std::function<void()>& publish) const {
    const Topics before = topics();
    publish();
    return Listener::until([&] {
      const Topics now = topics();
      return std::all_of(messages.begin(), messages.end(), [&](const auto& each) {
        const std::string topic = ros::names::resolve(each.first);
        const auto old = before.find(topic);
        return old == before.end() || old->second.empty() || countNew(old->second, now, topic) >= each.second;
      });
    });
  }

 private:
  using Connections = std::map<int, int>;  // messages by connection, which begins again when a publisher does
  using Topics = std::map<std::string, Connections>;

  static int countNew(const Connections& before, const Topics& now, const std::string& topic) {
    const auto found = now.find(topic);
    if (found == now.end()) return 0;
    int count = 0;
    for (const auto& [connection, messages] : found->second) {
      const auto old = before.find(connection);
      count += messages - (old == before.end() ? 0 : old->second);
    }
    return count;
  }

  /// Returns the subscriptions in getBusStats; nothing if the node does not answer.
  Topics topics() const {
    XmlRpc::XmlRpcValue request, response, uri, caller, answer;
    request[0] = ros::this_node::getName();
    request[1] = node_;
    std::string host;
    std::uint32_t port = 0;
    if (!ros::master::execute("lookupNode", request, response, uri, false) ||
        !ros::network::splitURI(std::string(uri), host, port))
      return {};
    XmlRpc::XmlRpcClient client(host.c_str(), static_cast<int>(port), "/");
    caller[0] = ros::this_node::getName();
    if (!client.execute("getBusStats", caller, answer) || answer.getType() != XmlRpc::XmlRpcValue::TypeArray ||
        answer.size() < 2)
      return {};
    // The statistics come after a code and a message by the specification, and without them from roscpp.
    XmlRpc::XmlRpcValue& statistics = answer[0].getType() == XmlRpc::XmlRpcValue::TypeInt ? answer[2] : answer;
    XmlRpc::XmlRpcValue& subscriptions = statistics[1];
    Topics topics;
    for (int i = 0; i < subscriptions.size(); ++i) {
      Connections& connections = topics[std::string(subscriptions[i][0])];
      XmlRpc::XmlRpcValue& rows = subscriptions[i][1];  // each: connection, bytes, messages, drops, state
      for (int k = 0; k < rows.size(); ++k) connections[static_cast<int>(rows[k][0])] = static_cast<int>(rows[k][2]);
    }
    return topics;
  }

  const std::string node_;
};

}  // namespace urban_nav_ros::testing
