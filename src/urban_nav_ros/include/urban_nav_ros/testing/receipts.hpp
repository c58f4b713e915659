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
#include <utility>
#include <vector>

#include "urban_nav_ros/testing/listener.hpp"

namespace urban_nav_ros::testing {

/// Counts the messages that a node has received or sent, from the statistics of its slave API. Each topic has its own
/// connection, and messages on different connections may overtake each other by any time on a slow machine. A message
/// that has been received is handled before all messages published later, on any topic.
class Receipts {
 public:
  /// Numbers of messages to wait for, by topic.
  using Messages = std::map<std::string, int>;

  explicit Receipts(const std::string& node) : node_(ros::names::resolve(node)) {}

  /// Calls `publish`, and waits until the node has received that many further messages on each topic. Topics to which
  /// it is not connected are ignored. Returns false after the timeout of Listener::until(). Requires that no earlier
  /// message on these topics is in flight.
  bool await(const Messages& messages, const std::function<void()>& publish) const {
    const Topics before = receivedBy(node_);
    publish();
    return Listener::until([&] {
      const Topics now = receivedBy(node_);
      return std::all_of(messages.begin(), messages.end(), [&](const auto& each) {
        const std::string topic = ros::names::resolve(each.first);
        const auto old = before.find(topic);
        return old == before.end() || old->second.empty() || countNew(old->second, now, topic) >= each.second;
      });
    });
  }

  /// Waits until all messages that the node has published so far on these topics have reached this process, and calls
  /// the callbacks. Returns false after the timeout of Listener::until(). Requires sufficient publisher queues: roscpp
  /// counts messages as sent that it then drops.
  bool drain(const std::vector<std::string>& topics) const {
    const auto sent = sentToThis();
    return Listener::until([&] {
      const Topics received = receivedBy(ros::this_node::getName());
      return std::all_of(topics.begin(), topics.end(), [&](const std::string& topic) {
        const std::string name = ros::names::resolve(topic);
        const auto found = sent.find(name);
        return found == sent.end() || countNew({}, received, name) >= found->second;
      });
    });
  }

 private:
  using Connections = std::map<int, int>;  // messages by connection; counters restart with the publisher
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

  /// Calls a method of a node's slave API. Returns false if the node does not answer.
  static bool call(const std::string& node, const char* method, XmlRpc::XmlRpcValue& result) {
    XmlRpc::XmlRpcValue request, response, uri, caller, answer;
    request[0] = ros::this_node::getName();
    request[1] = node;
    std::string host;
    std::uint32_t port = 0;
    if (!ros::master::execute("lookupNode", request, response, uri, false) ||
        !ros::network::splitURI(std::string(uri), host, port))
      return false;
    XmlRpc::XmlRpcClient client(host.c_str(), static_cast<int>(port), "/");
    caller[0] = ros::this_node::getName();
    if (!client.execute(method, caller, answer) || answer.getType() != XmlRpc::XmlRpcValue::TypeArray ||
        answer.size() < 2)
      return false;
    // The result comes after a code and a message by the specification; statistics of roscpp have neither.
    result = answer[0].getType() == XmlRpc::XmlRpcValue::TypeInt ? answer[2] : answer;
    return true;
  }

  /// Returns the number of messages that the node has sent to this process, by topic.
  std::map<std::string, int> sentToThis() const {
    XmlRpc::XmlRpcValue connections, statistics;
    std::map<std::string, int> sent;
    if (!call(node_, "getBusInfo", connections) || !call(node_, "getBusStats", statistics)) return sent;
    std::map<std::pair<std::string, int>, bool> is_ours;
    for (int i = 0; i < connections.size(); ++i) {  // each: connection, node, direction, transport, topic
      XmlRpc::XmlRpcValue& row = connections[i];
      if (std::string(row[2]) == "o" && std::string(row[1]) == ros::this_node::getName())
        is_ours[{std::string(row[4]), static_cast<int>(row[0])}] = true;
    }
    XmlRpc::XmlRpcValue& publications = statistics[0];
    for (int i = 0; i < publications.size(); ++i) {
      const std::string topic = publications[i][0];
      XmlRpc::XmlRpcValue& rows = publications[i][1];  // each: connection, bytes, bytes of data, messages
      for (int k = 0; k < rows.size(); ++k)
        if (is_ours.count({topic, static_cast<int>(rows[k][0])}) > 0) sent[topic] += static_cast<int>(rows[k][3]);
    }
    return sent;
  }

  /// Returns the messages by topic that a node has received; nothing if it does not answer.
  static Topics receivedBy(const std::string& node) {
    Topics topics;
    XmlRpc::XmlRpcValue statistics;
    if (!call(node, "getBusStats", statistics)) return topics;
    XmlRpc::XmlRpcValue& subscriptions = statistics[1];
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
