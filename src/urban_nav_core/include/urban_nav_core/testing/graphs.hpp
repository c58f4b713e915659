// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "urban_nav_core/geometry/se3.hpp"

namespace urban_nav_core::testing {
/// Kind of an edge of a simulated graph.
enum class GraphEdgeKind {
  Chain,    ///< odometry, from a pose to the next
  Closure,  ///< revisit of a place
};

/// T_a_b = [Exp(phi) R, t + rho] of the true relative pose, (rho, phi) drawn in the parent frame a with the covariance
/// information^-1 (docs/conventions.md).
struct GraphEdge {
  std::size_t a = 0, b = 0;
  Pose T_a_b;
  Matrix6d information = Matrix6d::Zero();
  GraphEdgeKind kind = GraphEdgeKind::Chain;
  bool wrong = false;  ///< more than 1 m or 0.35 rad from the truth, beyond its noise
};

/// Pose graph with ground truth. Uses its own composition of quaternions and vectors, so that the tested code is not
/// tested against itself.
struct SimulatedGraph {
  std::vector<Pose> truth;       ///< T_map_pose
  std::vector<GraphEdge> edges;  ///< first the chain in order, a to a + 1; then the closures
  bool planar = false;           ///< z, roll and pitch are zero, and carry no information
};

/// Standard deviations of the edges along x, y, z (m) and about x, y, z (rad) of the parent frame, all positive; planar
/// graphs use x, y and the last.
struct GraphNoise {
  Vector6d chain;
  Vector6d closure;
  double drawn = 1.0;  ///< scale of the drawn noise, in standard deviations: 0 makes measurements exact and keeps the
                       ///< information
};
/// Returns equal noise along and about all three axes, for chain and closures.
GraphNoise evenNoise(double sigma_m, double sigma_rad);

/// Circles on a sphere from pole to pole, `around` poses each, x along the path and z outwards; a closure from each
/// pose to that of the next circle (the shape of sphere2500, with 50 circles of 50).
SimulatedGraph sphereGraph(std::size_t rounds, std::size_t around, double radius_m, const GraphNoise& noise,
                           std::uint64_t seed);

/// Path through all points of a cubic lattice, row by row in alternating directions, x along the path; a closure
/// between two lattice neighbours that are not consecutive with probability `density`.
SimulatedGraph gridGraph(std::size_t nx, std::size_t ny, std::size_t nz, double spacing_m, double density,
                         const GraphNoise& noise, std::uint64_t seed);
/// Path through all points of a square lattice in the plane, with closures as in gridGraph().
SimulatedGraph planarGridGraph(std::size_t nx, std::size_t ny, double spacing_m, double density,
                               const GraphNoise& noise, std::uint64_t seed);

/// Random walk on a grid of `side` x `side` crossings 1 m apart (Olson, Leonard, Teller 2006), turning at a quarter of
/// its steps; a closure to an earlier visit of each crossing, in any heading, with probability `density`.
SimulatedGraph manhattanGraph(std::size_t poses, std::size_t side, double density, const GraphNoise& noise,
                              std::uint64_t seed);

/// Returns the true T_a_b.
Pose trueRelative(const SimulatedGraph& graph, std::size_t a, std::size_t b);
/// Return (rho, phi) of the edge's noise, and its squared Mahalanobis distance: chi-square with 6 degrees of freedom, 3
/// if planar.
Vector6d edgeError(const SimulatedGraph& graph, const GraphEdge& edge);
double edgeNees(const SimulatedGraph& graph, const GraphEdge& edge);
/// Appends an edge with random noise. `sigmas` as in GraphNoise.
class Dice;
void measure(SimulatedGraph& graph, std::size_t a, std::size_t b, GraphEdgeKind kind, const GraphNoise& noise,
             Dice& dice);

/// Returns the poses of dead reckoning by the chain from the true first pose, the initial guess of an estimator.
std::vector<Pose> deadReckoning(const SimulatedGraph& graph);

}  // namespace urban_nav_core::testing
