// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "urban_nav_core/geometry/se3.hpp"

namespace urban_nav_core::testing {

enum class GraphEdgeKind {
  Chain,    ///< odometry, from a pose to the next
  Closure,  ///< a place seen again
};

/// T_a_b = [Exp(phi) R, t + rho] of the true relative pose, (rho, phi) drawn in the parent frame a with the covariance
/// whose inverse is `information` (docs/conventions.md).
struct GraphEdge {
  std::size_t a = 0, b = 0;
  Pose T_a_b;
  Matrix6d information = Matrix6d::Zero();
  GraphEdgeKind kind = GraphEdgeKind::Chain;
  bool wrong = false;  ///< more than 1 m or 0.35 rad from the truth, and not by its noise
};

/// A pose graph with its truth. Composition in here is its own, of quaternions and vectors: what is tested with it does
/// not test itself.
struct SimulatedGraph {
  std::vector<Pose> truth;       ///< T_map_pose
  std::vector<GraphEdge> edges;  ///< first the chain in order, a to a + 1; then the closures
  bool planar = false;           ///< z, roll and pitch are zero, and carry no information
};

/// Standard deviations of the edges along x, y, z (m) and about x, y, z (rad) of the parent frame, all above zero;
/// planar graphs use x, y and the last.
struct GraphNoise {
  Vector6d chain;
  Vector6d closure;
  double drawn = 1.0;  ///< the noise that is drawn, in standard deviations: 0 makes measurements exact and keeps the
                       ///< information
};
/// The same along all three axes, and about all three; for chain and closures.
GraphNoise evenNoise(double sigma_m, double sigma_rad);

/// Rounds about a sphere from pole to pole, `around` poses a round, x along the way and z out; a closure from each pose
/// to the one a round on (the shape of the well-known sphere2500, which has 50 rounds of 50).
SimulatedGraph sphereGraph(std::size_t rounds, std::size_t around, double radius_m, const GraphNoise& noise,
                           std::uint64_t seed);

/// A way through all points of a cubic lattice, row after row to and fro, x along the way; a closure between two
/// neighbours of the lattice that do not follow each other with probability `density`.
SimulatedGraph gridGraph(std::size_t nx, std::size_t ny, std::size_t nz, double spacing_m, double density,
                         const GraphNoise& noise, std::uint64_t seed);
/// The same in the plane.
SimulatedGraph planarGridGraph(std::size_t nx, std::size_t ny, double spacing_m, double density,
                               const GraphNoise& noise, std::uint64_t seed);

/// A random walk along the lines of a city of `side` x `side` crossings 1 m apart (Olson, Leonard, Teller 2006), a
/// quarter of its steps with a turn; a closure to an earlier visit of each crossing with probability `density`, the
/// heading as it comes.
SimulatedGraph manhattanGraph(std::size_t poses, std::size_t side, double density, const GraphNoise& noise,
                              std::uint64_t seed);

/// The true T_a_b.
Pose trueRelative(const SimulatedGraph& graph, std::size_t a, std::size_t b);
/// (rho, phi) of the edge's noise, and its weighted square: chi-square with 6 degrees of freedom, 3 where planar.
Vector6d edgeError(const SimulatedGraph& graph, const GraphEdge& edge);
double edgeNees(const SimulatedGraph& graph, const GraphEdge& edge);
/// Appends an edge with drawn noise. `sigmas` as in GraphNoise.
class Dice;
void measure(SimulatedGraph& graph, std::size_t a, std::size_t b, GraphEdgeKind kind, const GraphNoise& noise,
             Dice& dice);

/// The poses that the chain alone gives, from the true first one: what an estimator starts from.
std::vector<Pose> deadReckoning(const SimulatedGraph& graph);

}  // namespace urban_nav_core::testing
