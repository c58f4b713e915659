// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "pose_graph/problem.hpp"

namespace pose_graph {

/// Initial guess of a minimisation.
enum class Start {
  Auto,      ///< the vertices or the result of chordal rotation relaxation, whichever has the lower cost
  Vertices,  ///< Problem::poses as they are
  Odometry,  ///< the chain of edges i to i + 1; a spanning tree where it breaks
  Identity,  ///< all poses at the identity, except fixed ones
};

/// Options of a minimisation with fixed weights.
struct SolveOptions {
  Objective objective = Objective::Geodesic;
  Start start = Start::Auto;
  int iterations = 100;     ///< at most
  double tolerance = 1e-9;  ///< converged if the expected further decrease is below this share of the cost
  /// With Start::Auto: search for another local minimum if the result is far from the measured rotations
  /// (solve/tangled.hpp).
  bool untangle = true;
  /// Called after each accepted step; return false to stop. May be empty.
  std::function<bool(int iteration, double cost)> progress;
};

/// One accepted step.
struct Iteration {
  double cost = 0.0;       ///< after the step
  double predicted = 0.0;  ///< decrease predicted by the linear model
  double damping = 0.0;    ///< 0: a plain Gauss-Newton step
  int refused = 0;
};

/// Why a minimisation ended.
enum class Ending {
  Converged,   ///< the expected further decrease is negligible
  Iterations,  ///< iteration limit reached
  Stopped,     ///< progress() returned false
  Stuck,       ///< no step lowers the cost: round-off, or directions without information
};
const char* toString(Ending ending);
/// Returns whether the minimisation ended before convergence without a request by the caller.
inline bool isEarly(Ending ending) { return ending == Ending::Iterations || ending == Ending::Stuck; }
/// Returns a message with the reason and the gradient norm if a minimisation ended early; otherwise an empty string.
std::string endingWarning(Ending ending, std::size_t iterations, double gradient);

/// Relaxed poses. Fixed poses keep their values. In a component without fixed poses, the first pose keeps its initial
/// value. With Start::Auto and given vertices, the result is moved so that pose 0 has its given value.
template <int D>
struct Solution {
  std::vector<Rigid<D>> poses;
  double cost_before = 0.0;  ///< of Problem::poses
  double cost_start = 0.0;   ///< of the initial guess
  double cost = 0.0;
  std::vector<Iteration> iterations;
  Ending ending = Ending::Converged;
  double gradient = 0.0;  ///< gradientNorm() at the result if the minimisation ended early
  int components = 0;     ///< number of connected components; each is relaxed in its own frame
  /// Rotations are far from the measured ones, so a lower local minimum may exist, and the graph is too large to search
  /// for one.
  bool may_be_tangled = false;
};

/// Returns the cost of given poses. `weights`: a factor per edge; empty: all 1.
template <int D>
double cost(const Problem<D>& problem, const std::vector<Rigid<D>>& poses, Objective objective,
            const std::vector<double>& weights = {});

/// Returns the Euclidean norm of the gradient of the cost with respect to the unknown poses (1/m, 1/rad). `weights` as
/// in cost().
template <int D>
double gradientNorm(const Problem<D>& problem, const std::vector<Rigid<D>>& poses, Objective objective,
                    const std::vector<double>& weights = {});

/// Minimises an objective over all poses. All returned poses are finite. Requires: a well-formed problem (problem.hpp).
template <int D>
Solution<D> solve(const Problem<D>& problem, const SolveOptions& options, const std::vector<double>& weights = {});

}  // namespace pose_graph
