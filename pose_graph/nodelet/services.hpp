// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <ros/service_server.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "worker.hpp"

namespace pose_graph {

/// The services of the stage: each asks the worker and waits for its turn, optimize for the end of the batch.
/// Files are read and copied in the caller's thread. To be advertised in a queue of its own threads, so that a caller who waits keeps no message waiting.
class Services {
 public:
  /// `worker` must outlive it.
  Services(ros::NodeHandle& nh, Worker& worker, std::function<void(bool)> pause);

 private:
  template <typename Service>
  using Action = std::function<void(const typename Service::Request&, typename Service::Response&)>;
  template <typename Service>
  void advertise(ros::NodeHandle& nh, const std::string& name, const Action<Service>& action);
  template <typename Service, typename Question>
  void advertiseQuestion(ros::NodeHandle& nh, const std::string& name, const Question& question);

  /// What the graph answers; UserError where it does not in time.
  template <typename Question>
  auto answer(const Question& question) -> decltype(question(std::declval<LiveGraph&>()));

  Worker& worker_;
  std::vector<ros::ServiceServer> servers_;
};

}  // namespace pose_graph
