// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <variant>
#include <vector>

#include "last_moved.hpp"
#include "live_graph.hpp"
#include "pose_graph/pose_graph.hpp"

namespace pose_graph {

/// The stage as the nodelet sees it: names the running session, holds closures back until odometry has reached their
/// poses, and turns what a relaxation did into what goes out.
class StageGraph : public LiveGraph {
 public:
  StageGraph(const Parameters& parameters, std::string robot, std::string recording);

  void add(const urban_nav_core::RelativePose& relative) override;
  /// A rejected closure is none.
  void add(const urban_nav_core::MetricClosure& closure) override;
  void add(const urban_nav_core::RelativeConstraint& constraint) override;

  bool wantsRelaxation() const override { return changed_ || !ready_.empty(); }
  Outcome relax(bool batch) override;

  std::int64_t revision() const override { return graph_.revision(); }
  StampNs newest() const override;
  Pose T_map_odom() const override;
  Picture picture() const override;
  Trajectory trajectory(StampNs from, StampNs to, std::int64_t since) const override;

  EdgeReply addEdge(const urban_nav_core::EdgeRef& edge, const urban_nav_core::Constraint& measured) override;
  EdgeReply removeEdge(const urban_nav_core::EdgeRef& edge) override;
  void save(const std::string& path) override;
  void load(const std::string& path) override;
  std::string newSession(const std::string& name) override;
  void reset() override;

 private:
  void begin(const std::string& name, StampNs start);
  NodeRef nodeOf(const urban_nav_core::PoseRef& ref) const;
  /// Odometry has not come so far yet.
  bool isAhead(const NodeRef& node) const;
  void offer(Closure closure);
  void offerWaiting();
  Outcome absorb(const Relaxed& relaxed);
  urban_nav_core::PoseRun runOf(const Track& track, const LastMoved::Range& range) const;
  const Track* running() const { return graph_.track(session_); }

  Parameters parameters_;
  std::string robot_, recording_;
  PoseGraph graph_;
  SessionId session_;             // empty until there is odometry
  std::deque<Closure> waiting_;   // for odometry
  std::vector<LastMoved> moved_;  // of each track
  std::deque<Outcome> ready_;     // of relaxations that a service made
  bool changed_ = false;          // since the last relaxation
};

}  // namespace pose_graph
