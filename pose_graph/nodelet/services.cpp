// SPDX-License-Identifier: BSD-3-Clause
#include "services.hpp"

#include <std_srvs/Trigger.h>
#include <urban_nav_msgs/AddEdge.h>
#include <urban_nav_msgs/FileCommand.h>
#include <urban_nav_msgs/GetTrajectory.h>
#include <urban_nav_msgs/NewSession.h>
#include <urban_nav_msgs/RemoveEdge.h>

#include <memory>

#include "live/closure_input.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_ros/closure.hpp"
#include "urban_nav_ros/graph.hpp"
#include "urban_nav_store/stored_ids.hpp"

namespace pose_graph {

using std_srvs::Trigger;
using urban_nav_core::UserError;
using urban_nav_msgs::AddEdge;
using urban_nav_msgs::FileCommand;
using urban_nav_msgs::GetTrajectory;
using urban_nav_msgs::NewSession;
using urban_nav_msgs::RemoveEdge;
using urban_nav_ros::toStampNs;

namespace {

// A batch relaxation of a million poses takes about ten seconds.
constexpr std::chrono::seconds kBatchTimeout{30};

void requireAbsolute(const std::string& path) {
  if (path.empty() || path.front() != '/') throw UserError("path", "`" + path + "`", "an absolute path");
}

void addEdge(LiveGraph& graph, const AddEdge::Request& request, AddEdge::Response& response) {
  const auto measured = urban_nav_ros::toConstraint(request.T_a_b, request.information);
  if (!measured) {
    throw UserError("", "invalid transform or information",
                    "finite numbers, a unit quaternion (1 %), a symmetric matrix");
  }
  Closure edge;
  edge.a = {request.a.session, toStampNs(request.a.stamp)};
  edge.b = {request.b.session, toStampNs(request.b.stamp)};
  edge.kind = toEdgeKind(request.kind);
  edge.source = request.source.empty() ? "operator" : request.source;
  edge.measured = *measured;
  const auto reply = graph.addEdge(edge);
  response.message = reply.message;
  for (const auto& other : reply.contradicting)
    response.contradicting.push_back(urban_nav_ros::toEdgeRefMessage(other));
}

void getTrajectory(LiveGraph& graph, const GetTrajectory::Request& request, GetTrajectory::Response& response) {
  const auto trajectory = graph.trajectory(toStampNs(request.from_stamp), toStampNs(request.to_stamp),
                                           static_cast<std::int64_t>(request.revision));
  response.revision = static_cast<std::uint64_t>(trajectory.revision);
  for (const auto& run : trajectory.segments)
    response.segments.push_back(urban_nav_ros::toTrajectorySegmentMessage(run));
}

/// Advertises a service that is answered in the worker's thread.
template <typename Service, typename Question>
void advertiseQuestion(GraphNode& node, GraphWorker& worker, const std::string& name, const Question& question) {
  using Request = typename Service::Request;
  using Response = typename Service::Response;
  node.advertiseService<Service>(name, [&node, &worker, question](const Request& request, Response& response) {
    // Captured by value: the worker may evaluate the request after the caller's timeout.
    response = node.ask([&worker, question, request] {
      Response made;
      made.success = true;
      question(worker.graph(), request, made);
      return made;
    });
  });
}

void save(GraphNode& node, GraphWorker& worker, const std::string& path, std::string& message) {
  requireAbsolute(path);
  const LiveGraph::DeferredTask rest = node.ask([&worker, path] { return worker.graph().save(path); });
  message = path + ": " + rest();
}

void load(GraphNode& node, GraphWorker& worker, const std::string& path, std::string& message) {
  requireAbsolute(path);
  urban_nav_store::Store store = urban_nav_store::openForReading(path);
  const auto stored = std::make_shared<const StoredGraph>(readGraph(store));
  message = path + ": " + node.ask([&worker, stored] { return worker.graph().load(*stored); });
}

std::string optimize(GraphNode& node, GraphWorker& worker) {
  std::future<Figures> ended = node.ask([&worker] { return worker.requestBatch(); });
  if (ended.wait_for(kBatchTimeout) != std::future_status::ready)
    throw UserError("", "the batch relaxation is still running; graph/state reports its end", "");
  try {
    return toSentence(ended.get());
  } catch (const std::future_error&) {
    throw UserError("", "the batch relaxation was dropped: the input queue is full, or the nodelet is shutting down",
                    "");
  }
}

}  // namespace

void advertiseServices(GraphNode& node, GraphWorker& worker) {
  advertiseQuestion<AddEdge>(node, worker, "add_edge", addEdge);
  advertiseQuestion<GetTrajectory>(node, worker, "get_trajectory", getTrajectory);
  advertiseQuestion<RemoveEdge>(node, worker, "remove_edge", [](LiveGraph& graph, const auto& request, auto& response) {
    response.message = graph.removeEdge(urban_nav_ros::toEdgeRef(request.edge)).message;
  });
  advertiseQuestion<NewSession>(node, worker, "new_session", [](LiveGraph& graph, const auto& request, auto& response) {
    response.session = graph.newSession(request.name);
    response.message = "session " + response.session + " has begun";
  });
  node.advertiseService<FileCommand>(
      "save", [&](const auto& request, auto& response) { save(node, worker, request.path, response.message); });
  node.advertiseService<FileCommand>(
      "load", [&](const auto& request, auto& response) { load(node, worker, request.path, response.message); });
  node.advertiseService<Trigger>("optimize",
                                 [&](const auto&, auto& response) { response.message = optimize(node, worker); });
}

}  // namespace pose_graph
