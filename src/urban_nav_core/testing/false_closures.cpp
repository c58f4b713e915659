// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/testing/false_closures.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "urban_nav_core/testing/dice.hpp"

namespace urban_nav_core::testing {

namespace {

constexpr double kSigmaPlace = 0.3, kSigmaAngle = 0.17453292519943295;  // m; 10 deg
constexpr std::size_t kLocal = 20;                                      // poses
constexpr double kRightWithin = 1.0, kRightWithinAngle = 0.35;          // m, rad

const GraphEdge& firstClosure(const SimulatedGraph& graph) {
  const auto found = std::find_if(graph.edges.begin(), graph.edges.end(),
                                  [](const GraphEdge& edge) { return edge.kind == GraphEdgeKind::Closure; });
  if (found == graph.edges.end()) throw std::invalid_argument("the graph has no closure whose information to take");
  return *found;
}

/// Returns a transform near the identity: the robot has returned with a small offset.
Pose nearlyTheSame(bool planar, Dice& dice) {
  Vector3d t = kSigmaPlace * dice.normals<3>(), angles = kSigmaAngle * dice.normals<3>();  // roll, pitch, yaw
  if (planar) t.z() = angles.x() = angles.y() = 0.0;
  const Quaterniond q(Eigen::AngleAxisd(angles.z(), Vector3d::UnitZ()) *
                      Eigen::AngleAxisd(angles.y(), Vector3d::UnitY()) *
                      Eigen::AngleAxisd(angles.x(), Vector3d::UnitX()));
  return {q, t};
}

bool isWrong(const SimulatedGraph& graph, const GraphEdge& edge) {
  const Vector6d off = edgeError(graph, edge);
  return off.head<3>().norm() > kRightWithin || off.tail<3>().norm() > kRightWithinAngle;
}

std::vector<std::size_t> posesWithin(const SimulatedGraph& graph, const Vector3d& place, double radius) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < graph.truth.size(); ++i)
    if ((graph.truth[i].t() - place).norm() <= radius) found.push_back(i);
  return found;
}

}  // namespace

void addFalseClosures(SimulatedGraph& graph, FalseClosures kind, std::size_t count, std::uint64_t seed,
                      std::size_t group) {
  const bool grouped = kind == FalseClosures::RandomGrouped || kind == FalseClosures::LocalGrouped;
  const bool local = kind == FalseClosures::Local || kind == FalseClosures::LocalGrouped;
  if (!grouped) group = 1;
  const std::size_t poses = graph.truth.size();
  if (group == 0 || poses < group + 2) throw std::invalid_argument("too few poses for false closures");
  const Matrix6d information = firstClosure(graph).information;
  const std::size_t last = poses - 1 - group;
  Dice dice(seed);
  for (std::size_t made = 0; made < count;) {
    std::size_t a = 0, b = 0;
    while (a == b) {
      a = dice.below(last + 1);
      b = local ? a + dice.below(std::min(kLocal, last - a) + 1) : dice.below(last + 1);
    }
    if (a > b) std::swap(a, b);
    if (b == a + 1) b = a + 2;
    const Pose T = nearlyTheSame(graph.planar, dice);
    for (std::size_t k = 0; k < group && made < count; ++k, ++made) {
      GraphEdge edge;
      edge.a = a + k, edge.b = b + k, edge.T_a_b = T, edge.information = information;
      edge.kind = GraphEdgeKind::Closure;
      edge.wrong = isWrong(graph, edge);
      graph.edges.push_back(edge);
    }
  }
}

void addAliasedClosures(SimulatedGraph& graph, const AliasOptions& options, std::uint64_t seed) {
  const Matrix6d information = firstClosure(graph).information;
  const Vector6d sigma = information.diagonal().unaryExpr([](double w) { return w > 0.0 ? 1.0 / std::sqrt(w) : 0.0; });
  Dice dice(seed);
  const double apart = options.apart_m + 2.0 * options.radius_m;
  for (std::size_t pair = 0; pair < options.pairs; ++pair) {
    std::size_t one = 0, other = 0;
    for (int attempt = 0; (graph.truth[one].t() - graph.truth[other].t()).norm() <= apart; ++attempt) {
      if (attempt == 10000) throw std::invalid_argument("no two places of the graph are so far apart");
      one = dice.below(graph.truth.size()), other = dice.below(graph.truth.size());
    }
    const std::vector<std::size_t> here = posesWithin(graph, graph.truth[one].t(), options.radius_m);
    const std::vector<std::size_t> there = posesWithin(graph, graph.truth[other].t(), options.radius_m);
    for (std::size_t made = 0; made < options.closures; ++made) {
      GraphEdge edge;
      edge.a = here[dice.below(here.size())], edge.b = there[dice.below(there.size())];
      if (edge.a > edge.b) std::swap(edge.a, edge.b);
      const bool swapped = std::binary_search(there.begin(), there.end(), edge.a);
      // Pose of b relative to a if the two places were one.
      const Pose a = trueRelative(graph, swapped ? other : one, edge.a),
                 b = trueRelative(graph, swapped ? one : other, edge.b);
      const Vector6d noise = sigma.cwiseProduct(dice.normals<6>());
      const double angle = noise.tail<3>().norm();
      const Quaterniond shaken(
          Eigen::AngleAxisd(angle, angle > 0.0 ? Vector3d(noise.tail<3>() / angle) : Vector3d::UnitZ()));
      const Quaterniond back = a.q().conjugate();
      edge.T_a_b = Pose(shaken * back * b.q(), back * Vector3d(b.t() - a.t()) + noise.head<3>());
      edge.information = information;
      edge.kind = GraphEdgeKind::Closure;
      edge.wrong = true;
      graph.edges.push_back(edge);
    }
  }
}

}  // namespace urban_nav_core::testing
