// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/testing/graphs.hpp"

#include <array>
#include <cmath>
#include <cstdlib>

#include "urban_nav_core/testing/dice.hpp"

namespace urban_nav_core::testing {

namespace {

/// Returns the rotation with x along `forward` and z as close to `up` as possible. Both are non-zero and not parallel.
Pose headingAlong(const Vector3d& position, const Vector3d& forward, const Vector3d& up) {
  const Vector3d x = forward.normalized(), y = up.cross(x).normalized();
  Matrix3d R;
  R << x, y, x.cross(y);
  return {Quaterniond(R), position};
}

Quaterniond turnBy(const Vector3d& phi) {
  const double angle = phi.norm();
  if (angle == 0.0) return Quaterniond::Identity();
  return Quaterniond(Eigen::AngleAxisd(angle, phi / angle));
}

Vector3d toTurn(const Quaterniond& q) {
  const Eigen::AngleAxisd turn(q.w() < 0.0 ? Quaterniond(-q.coeffs()) : q);
  return turn.angle() * turn.axis();
}

void chainUp(SimulatedGraph& graph, const GraphNoise& noise, Dice& dice) {
  graph.edges.reserve(2 * graph.truth.size());
  for (std::size_t i = 0; i + 1 < graph.truth.size(); ++i) measure(graph, i, i + 1, GraphEdgeKind::Chain, noise, dice);
}

using Lattice = std::array<std::size_t, 3>;

/// Returns the lattice point of the alternating path after `index` steps.
Lattice toAndFro(std::size_t index, const Lattice& size) {
  const std::size_t z = index / (size[0] * size[1]), inLayer = index % (size[0] * size[1]);
  std::size_t y = inLayer / size[0], x = inLayer % size[0];
  if ((y + z * size[1]) % 2 == 1) x = size[0] - 1 - x;
  if (z % 2 == 1) y = size[1] - 1 - y;
  return {x, y, z};
}

/// Returns the step at which the path visits the lattice point.
std::size_t stepAt(const Lattice& at, const Lattice& size) {
  const std::size_t y = at[2] % 2 == 1 ? size[1] - 1 - at[1] : at[1];
  const std::size_t x = (y + at[2] * size[1]) % 2 == 1 ? size[0] - 1 - at[0] : at[0];
  return (at[2] * size[1] + y) * size[0] + x;
}

SimulatedGraph latticeGraph(const Lattice& size, double spacing_m, double density, bool planar, const GraphNoise& noise,
                            std::uint64_t seed) {
  SimulatedGraph graph;
  graph.planar = planar;
  Dice dice(seed);
  const std::size_t count = size[0] * size[1] * size[2];
  const auto place = [&](std::size_t i) {
    const Lattice at = toAndFro(i, size);
    return Vector3d(spacing_m *
                    Vector3d(static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])));
  };
  for (std::size_t i = 0; i < count; ++i) {
    const Vector3d forward = i + 1 < count ? Vector3d(place(i + 1) - place(i)) : Vector3d::UnitX();
    const bool upwards = std::abs(forward.z()) > 0.5 * spacing_m;
    graph.truth.push_back(
        headingAlong(place(i), forward, upwards ? Vector3d(-1.0, 0.0, 0.0) : Vector3d(0.0, 0.0, 1.0)));
  }
  chainUp(graph, noise, dice);
  for (std::size_t i = 0; i < count; ++i) {
    const Lattice at = toAndFro(i, size);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Lattice next = at;
      if (++next[axis] >= size[axis]) continue;
      const std::size_t j = stepAt(next, size);
      if (j == i + 1 || i == j + 1 || !dice.chance(density)) continue;
      measure(graph, i, j, GraphEdgeKind::Closure, noise, dice);
    }
  }
  return graph;
}

}  // namespace

GraphNoise evenNoise(double sigma_m, double sigma_rad) {
  GraphNoise noise;
  noise.chain << Vector3d::Constant(sigma_m), Vector3d::Constant(sigma_rad);
  noise.closure = noise.chain;
  return noise;
}

SimulatedGraph sphereGraph(std::size_t rounds, std::size_t around, double radius_m, const GraphNoise& noise,
                           std::uint64_t seed) {
  SimulatedGraph graph;
  Dice dice(seed);
  const double count = static_cast<double>(rounds * around);
  for (std::size_t i = 0; i < rounds * around; ++i) {
    const double polar = M_PI * (static_cast<double>(i) + 0.5) / count;
    const double azimuth = 2.0 * M_PI * static_cast<double>(i) / static_cast<double>(around);
    const Vector3d out(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), -std::cos(polar));
    graph.truth.push_back(headingAlong(radius_m * out, Vector3d(-std::sin(azimuth), std::cos(azimuth), 0.0), out));
  }
  chainUp(graph, noise, dice);
  for (std::size_t i = 0; i + around < graph.truth.size(); ++i)
    measure(graph, i, i + around, GraphEdgeKind::Closure, noise, dice);
  return graph;
}

SimulatedGraph gridGraph(std::size_t nx, std::size_t ny, std::size_t nz, double spacing_m, double density,
                         const GraphNoise& noise, std::uint64_t seed) {
  return latticeGraph({nx, ny, nz}, spacing_m, density, false, noise, seed);
}

SimulatedGraph planarGridGraph(std::size_t nx, std::size_t ny, double spacing_m, double density,
                               const GraphNoise& noise, std::uint64_t seed) {
  return latticeGraph({nx, ny, 1}, spacing_m, density, true, noise, seed);
}

SimulatedGraph manhattanGraph(std::size_t poses, std::size_t side, double density, const GraphNoise& noise,
                              std::uint64_t seed) {
  constexpr std::array<std::array<int, 2>, 4> kSteps = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
  SimulatedGraph graph;
  graph.planar = true;
  Dice dice(seed);
  const int last = static_cast<int>(side) - 1;
  int x = last / 2, y = last / 2;
  std::size_t heading = 0;
  std::vector<std::vector<std::size_t>> visits(side * side);
  for (std::size_t i = 0; i < poses; ++i) {
    const double yaw = 0.5 * M_PI * static_cast<double>(heading);
    graph.truth.emplace_back(Quaterniond(Eigen::AngleAxisd(yaw, Vector3d::UnitZ())),
                             Vector3d(static_cast<double>(x), static_cast<double>(y), 0.0));
    visits[static_cast<std::size_t>(y) * side + static_cast<std::size_t>(x)].push_back(i);
    // x points along the step that led to the pose.
    if (dice.chance(0.25)) heading = (heading + (dice.chance(0.5) ? 1 : 3)) % 4;
    const auto leads = [&](std::size_t h) {
      const int nx = x + kSteps[h][0], ny = y + kSteps[h][1];
      return nx >= 0 && nx <= last && ny >= 0 && ny <= last;
    };
    while (!leads(heading)) heading = (heading + (dice.chance(0.5) ? 1 : 3)) % 4;
    x += kSteps[heading][0], y += kSteps[heading][1];
  }
  chainUp(graph, noise, dice);
  for (const std::vector<std::size_t>& visit : visits)
    for (std::size_t k = 1; k < visit.size(); ++k)
      if (dice.chance(density)) measure(graph, visit[dice.below(k)], visit[k], GraphEdgeKind::Closure, noise, dice);
  return graph;
}

Pose trueRelative(const SimulatedGraph& graph, std::size_t a, std::size_t b) {
  const Quaterniond back = graph.truth[a].q().conjugate();
  return {back * graph.truth[b].q(), back * Vector3d(graph.truth[b].t() - graph.truth[a].t())};
}

Vector6d edgeError(const SimulatedGraph& graph, const GraphEdge& edge) {
  const Pose exact = trueRelative(graph, edge.a, edge.b);
  Vector6d error;
  error << edge.T_a_b.t() - exact.t(), toTurn(edge.T_a_b.q() * exact.q().conjugate());
  return error;
}

double edgeNees(const SimulatedGraph& graph, const GraphEdge& edge) {
  const Vector6d error = edgeError(graph, edge);
  return error.dot(edge.information * error);
}

void measure(SimulatedGraph& graph, std::size_t a, std::size_t b, GraphEdgeKind kind, const GraphNoise& noise,
             Dice& dice) {
  Vector6d sigma = kind == GraphEdgeKind::Chain ? noise.chain : noise.closure;
  Vector6d weight = sigma.cwiseAbs2().cwiseInverse();
  if (graph.planar) sigma.segment<3>(2).setZero(), weight.segment<3>(2).setZero();
  const Vector6d drawn = noise.drawn * sigma.cwiseProduct(dice.normals<6>());
  const Pose exact = trueRelative(graph, a, b);
  GraphEdge edge;
  edge.a = a, edge.b = b, edge.kind = kind;
  edge.T_a_b = Pose(turnBy(drawn.tail<3>()) * exact.q(), exact.t() + drawn.head<3>());
  edge.information = weight.asDiagonal();
  graph.edges.push_back(edge);
}

std::vector<Pose> deadReckoning(const SimulatedGraph& graph) {
  std::vector<Pose> poses = {graph.truth.front()};
  poses.reserve(graph.truth.size());
  for (std::size_t i = 0; i + 1 < graph.truth.size(); ++i) {
    const Pose& last = poses.back();
    const Pose& step = graph.edges[i].T_a_b;
    poses.emplace_back(last.q() * step.q(), last.t() + last.q() * step.t());
  }
  return poses;
}

}  // namespace urban_nav_core::testing
