// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "pose_graph/problem.hpp"

namespace pose_graph {

/// Where the minimisation begins.
enum class Start {
  Auto,      ///< the vertices or the rotations found by chordal relaxation, whichever cost less
  Vertices,  ///< Problem::poses as they are
  Odometry,  ///< the chain of edges i to i + 1; where it breaks, a spanning tree
  Identity,  ///< all poses at the origin, unturned, but the fixed ones
};

/// Options of one minimisation with fixed weights.
struct SolveOptions {
  Objective objective = Objective::Geodesic;
  Start start = Start::Auto;
  int iterations = 100;     ///< at most
  double tolerance = 1e-9;  ///< ends where what is left to gain is expected to be less than this share of the cost
  /// With Start::Auto, to look for another valley where the result is tangled (solve/tangled.hpp).
  bool untangle = true;
  /// Called after each accepted step; return false to end there. May be empty.
  std::function<bool(int iteration, double cost)> progress;
};

/// One accepted step, and how many were refused before it.
struct Iteration {
  double cost = 0.0;       ///< after the step
  double predicted = 0.0;  ///< decrease that the linear model promised
  double damping = 0.0;    ///< 0: a plain Gauss-Newton step
  int refused = 0;
};

/// Why a minimisation ended.
enum class Ending {
  Converged,   ///< nothing worth the name is left to gain
  Iterations,  ///< as many as allowed
  Stopped,     ///< the caller's progress() said so
  Stuck,       ///< no step, however small, lowers the cost: round-off, or directions without information
};
const char* toString(Ending ending);
/// Whether the minimisation ended before it was done without a request for that.
inline bool isEarly(Ending ending) { return ending == Ending::Iterations || ending == Ending::Stuck; }
/// A sentence for the user: why a minimisation ended early, with the norm of the gradient there. Empty if it did not.
std::string endingWarning(Ending ending, std::size_t iterations, double gradient);

/// Relaxed poses. Fixed poses stay where they are given. The first pose of each connected component without any stays
/// where the start had it; where the problem has poses given for Start::Auto, the result is moved so that pose 0 stays
/// at its given place.
template <int D>
struct Solution {
  std::vector<Rigid<D>> poses;
  double cost_before = 0.0;  ///< of Problem::poses
  double cost_start = 0.0;   ///< of where the minimisation began
  double cost = 0.0;
  std::vector<Iteration> iterations;
  Ending ending = Ending::Converged;
  double gradient = 0.0;  ///< where it ended early, gradientNorm() there
  int components = 0;     ///< parts of the graph that no edge connects; each is relaxed in its own frame
  /// Rotations end up far from what edges measure, so that there may be a better valley, and the graph is too large to
  /// look for one.
  bool may_be_tangled = false;
};

/// Cost of given poses. `weights`: a factor for each edge, or empty for ones.
template <int D>
double cost(const Problem<D>& problem, const std::vector<Rigid<D>>& poses, Objective objective,
            const std::vector<double>& weights = {});

/// Euclidean norm of the derivatives of the cost by moves of the unknown poses, 1/m and 1/rad. `weights` as in cost().
template <int D>
double gradientNorm(const Problem<D>& problem, const std::vector<Rigid<D>>& poses, Objective objective,
                    const std::vector<double>& weights = {});

/// The sum over edges of an objective, minimised over all poses. See Relaxation for many of the same graph.
/// The problem must be sound (check.hpp); never returns a pose that is not finite.
template <int D>
Solution<D> solve(const Problem<D>& problem, const SolveOptions& options, const std::vector<double>& weights = {});

}  // namespace pose_graph
