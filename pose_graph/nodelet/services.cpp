// SPDX-License-Identifier: BSD-3-Clause
#include "services.hpp"

#include <std_srvs/Trigger.h>
#include <urban_nav_msgs/AddEdge.h>
#include <urban_nav_msgs/FileCommand.h>
#include <urban_nav_msgs/GetTrajectory.h>
#include <urban_nav_msgs/NewSession.h>
#include <urban_nav_msgs/RemoveEdge.h>

#include <boost/function.hpp>
#include <iomanip>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "urban_nav_core/types/error.hpp"
#include "urban_nav_ros/closure.hpp"
#include "urban_nav_ros/graph.hpp"
#include "urban_nav_ros/stamp.hpp"

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

// A batch relaxation of a million poses takes some ten seconds, and a question may come behind one.
constexpr std::chrono::seconds patience{30};
constexpr const char* still_at_work = "the graph is still at work on what came before; ask again";

void demandPath(const std::string& path) {
  if (path.empty() || path.front() != '/') throw UserError("path", "`" + path + "`", "an absolute path");
}

void addEdge(LiveGraph& graph, const AddEdge::Request& request, AddEdge::Response& response) {
  const auto measured = urban_nav_ros::toConstraint(request.T_a_b, request.information);
  if (!measured) {
    throw UserError("", "the transform or its information",
                    "finite numbers, a quaternion of length 1 (1 %), a symmetric matrix");
  }
  if (request.kind != "asserted" && request.kind != "stereo" && request.kind != "icp" && request.kind != "plane")
    throw UserError("kind", "`" + request.kind + "`", "asserted, stereo, icp, plane");
  const std::string source = request.source.empty() ? "operator" : request.source;
  const auto reply = graph.addEdge(
      {urban_nav_ros::toPoseRef(request.a), urban_nav_ros::toPoseRef(request.b), request.kind, source}, *measured);
  response.message = reply.message;
  for (const auto& edge : reply.contradicting) response.contradicting.push_back(urban_nav_ros::toEdgeRefMessage(edge));
}

std::string sentenceOf(std::future<Figures>& ended) {
  try {
    const Figures figures = ended.get();
    std::ostringstream text;
    text << figures.poses << " poses, " << figures.closures << " closures, " << figures.closures_rejected
         << " rejected, " << figures.closures_waiting << " waiting; cost " << std::setprecision(5)
         << figures.cost_before << " -> " << figures.cost_after << " in " << std::setprecision(3) << figures.relax_ms
         << " ms";
    return text.str();
  } catch (const std::future_error&) {
    throw UserError("", "the batch relaxation was dropped: too many inputs wait, or the nodelet ends", "");
  }
}

void getTrajectory(LiveGraph& graph, const GetTrajectory::Request& request, GetTrajectory::Response& response) {
  const auto trajectory = graph.trajectory(toStampNs(request.from_stamp), toStampNs(request.to_stamp),
                                           static_cast<std::int64_t>(request.revision));
  response.revision = static_cast<std::uint64_t>(trajectory.revision);
  for (const auto& run : trajectory.runs) response.runs.push_back(urban_nav_ros::toPoseRunMessage(run));
}

}  // namespace

template <typename Service>
void Services::advertise(ros::NodeHandle& nh, const std::string& name, const Action<Service>& action) {
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
  servers_.push_back(nh.advertiseService(name, callback));
}

template <typename Service, typename Question>
void Services::advertiseQuestion(ros::NodeHandle& nh, const std::string& name, const Question& question) {
  using Request = typename Service::Request;
  using Response = typename Service::Response;
  advertise<Service>(nh, name, [this, question](const Request& request, Response& response) {
    // By value: the worker may get to it after the caller has given up.
    response = answer([question, request](LiveGraph& graph) {
      Response made;
      made.success = true;
      question(graph, request, made);
      return made;
    });
  });
}

template <typename Question>
auto Services::answer(const Question& question) -> decltype(question(std::declval<LiveGraph&>())) {
  auto answer = worker_.ask(question, patience);
  if (!answer) throw UserError("", still_at_work, "");
  return std::move(*answer);
}

Services::Services(ros::NodeHandle& nh, Worker& worker, std::function<void(bool)> pause) : worker_(worker) {
  advertiseQuestion<AddEdge>(nh, "add_edge", addEdge);
  advertiseQuestion<GetTrajectory>(nh, "get_trajectory", getTrajectory);
  advertiseQuestion<RemoveEdge>(
      nh, "remove_edge", [](LiveGraph& graph, const RemoveEdge::Request& request, RemoveEdge::Response& response) {
        response.message = graph.removeEdge(urban_nav_ros::toEdgeRef(request.edge)).message;
      });
  advertise<FileCommand>(nh, "save", [this](const FileCommand::Request& request, FileCommand::Response& response) {
    demandPath(request.path);
    const LiveGraph::Rest rest = answer([path = request.path](LiveGraph& graph) { return graph.save(path); });
    response.message = request.path + ": " + rest();
  });
  advertise<FileCommand>(nh, "load", [this](const FileCommand::Request& request, FileCommand::Response& response) {
    demandPath(request.path);
    urban_nav_store::Store store(request.path, urban_nav_store::Access::Read);
    const auto stored = std::make_shared<const StoredGraph>(readGraph(store));
    response.message = request.path + ": " + answer([stored](LiveGraph& graph) { return graph.load(*stored); });
  });
  advertiseQuestion<NewSession>(
      nh, "new_session", [](LiveGraph& graph, const NewSession::Request& request, NewSession::Response& response) {
        response.session = graph.newSession(request.name);
        response.message = "session " + response.session + " has begun";
      });
  advertiseQuestion<Trigger>(nh, "reset", [](LiveGraph& graph, const Trigger::Request&, Trigger::Response& response) {
    graph.reset();
    response.message = "the graph is empty";
  });
  advertise<Trigger>(nh, "optimize", [this](const Trigger::Request&, Trigger::Response& response) {
    std::future<Figures> ended = worker_.optimize();
    if (ended.wait_for(patience) != std::future_status::ready)
      throw UserError("", "the batch relaxation is still under way; graph/state says when it has ended", "");
    response.message = sentenceOf(ended);
  });
  advertise<Trigger>(nh, "pause", [pause](const Trigger::Request&, Trigger::Response& response) {
    pause(true);
    response.message = "inputs are dropped until resume";
  });
  advertise<Trigger>(nh, "resume", [pause](const Trigger::Request&, Trigger::Response& response) {
    pause(false);
    response.message = "the session goes on";
  });
}

}  // namespace pose_graph
