// SPDX-License-Identifier: BSD-3-Clause
// The only file that includes Ceres.
#include "pose_graph_ceres/solve_by_ceres.hpp"

#include <ceres/iteration_callback.h>
#include <ceres/problem.h>
#include <ceres/sized_cost_function.h>
#include <ceres/solver.h>

#include <memory>

#include "edge_residual.hpp"
#include "linear/index.hpp"
#include "solve/normal_equations.hpp"
#include "urban_nav_core/geometry/dense.hpp"

namespace pose_graph {

namespace {

// Returns the pose at increment x; toTurn() is the derivative of its rotation in the map's axes with respect to x.
template <int D>
Rigid<D> at(const Rigid<D>& base, const double* x) {
  return moved<D>(base, Eigen::Map<const Tangent<D>>(x));
}
Eigen::Matrix<double, 1, 1> toTurn(const RotationVector<2>&) { return Eigen::Matrix<double, 1, 1>::Ones(); }
Eigen::Matrix3d toTurn(const RotationVector<3>& phi) { return urban_nav_core::leftJacobianSo3(phi); }

template <Objective objective, int D>
class EdgeCost final : public ceres::SizedCostFunction<kResidualSize<objective, D>, kTangentSize<D>, kTangentSize<D>> {
 public:
  EdgeCost(const EdgeTerm<D>& term, const TangentMatrix<D>& root, const Rigid<D>& from, const Rigid<D>& to)
      : term_(term), root_(root), from_(from), to_(to) {}

  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override {
    constexpr int kK = kResidualSize<objective, D>, kN = kTangentSize<D>;
    const EdgeResidual<objective, D> edge =
        edgeResidual<objective, D>(term_, root_, at<D>(from_, x[0]), at<D>(to_, x[1]));
    Eigen::Map<Eigen::Matrix<double, kK, 1>> r(residuals);
    r = edge.r;
    if (jacobians == nullptr) return r.allFinite();
    const auto put = [](const Eigen::Matrix<double, kK, kN>& J, const double* at_x, double* jacobian) {
      if (jacobian == nullptr) return;
      Eigen::Map<Eigen::Matrix<double, kK, kN, Eigen::RowMajor>> out(jacobian);
      out = J;
      out.template rightCols<kRotationSize<D>>() =
          J.template rightCols<kRotationSize<D>>() *
          toTurn(RotationVector<D>(Eigen::Map<const RotationVector<D>>(at_x + D)));
    };
    put(edge.J_from, x[0], jacobians[0]);
    put(edge.J_to, x[1], jacobians[1]);
    return r.allFinite();
  }

 private:
  EdgeTerm<D> term_;
  TangentMatrix<D> root_;
  Rigid<D> from_, to_;
};

// Returns the root of an information: root^T root = information, which may be singular.
template <int D>
TangentMatrix<D> informationRoot(const TangentMatrix<D>& information) {
  const auto eigen = urban_nav_core::symmetricEigen(information);
  if (!eigen) return TangentMatrix<D>::Zero();
  return eigen->values.cwiseMax(0.0).cwiseSqrt().asDiagonal() * eigen->vectors.transpose();
}

class ProgressCallback final : public ceres::IterationCallback {
 public:
  ProgressCallback(const SolveOptions& options, std::vector<Iteration>& iterations)
      : options_(options), iterations_(iterations) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    if (summary.iteration == 0) return ceres::SOLVER_CONTINUE;
    if (!summary.step_is_successful) {
      ++refused_;
      return ceres::SOLVER_CONTINUE;
    }
    Iteration step;
    step.cost = 2.0 * summary.cost;
    step.damping = 1.0 / summary.trust_region_radius;
    step.refused = refused_;
    refused_ = 0;
    iterations_.push_back(step);
    const bool on = !options_.progress || options_.progress(static_cast<int>(iterations_.size()), step.cost);
    return on ? ceres::SOLVER_CONTINUE : ceres::SOLVER_TERMINATE_SUCCESSFULLY;
  }

 private:
  const SolveOptions& options_;
  std::vector<Iteration>& iterations_;
  int refused_ = 0;
};

template <Objective objective, int D>
void descend(const Problem<D>& problem, const SolveOptions& options, const std::vector<double>& weights,
             Solution<D>& made) {
  const Unknowns unknowns = makeUnknowns(problem);
  std::vector<Tangent<D>> x(problem.poses.size(), Tangent<D>::Zero());
  ceres::Problem all;
  for (std::size_t i = 0; i < x.size(); ++i) {
    all.AddParameterBlock(x[i].data(), kTangentSize<D>);
    if (unknowns.of_pose[i] < 0) all.SetParameterBlockConstant(x[i].data());
  }
  for (std::size_t e = 0; e < problem.edges.size(); ++e) {
    Edge<D> edge = problem.edges[e];
    if (!weights.empty()) edge.information *= weights[e];
    const EdgeTerm<D> term = makeTerm(edge);
    all.AddResidualBlock(
        new EdgeCost<objective, D>(term, informationRoot<D>(edge.information), made.poses[sz(edge.from)],
                                   made.poses[sz(edge.to)]),  // Ceres owns it
        nullptr, x[sz(edge.from)].data(), x[sz(edge.to)].data());
  }
  ProgressCallback progress(options, made.iterations);
  ceres::Solver::Options wanted;
  wanted.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  wanted.sparse_linear_algebra_library_type = ceres::SUITE_SPARSE;
  wanted.num_threads = 1;
  wanted.max_num_iterations = options.iterations;
  wanted.function_tolerance = options.tolerance;
  wanted.gradient_tolerance = wanted.parameter_tolerance = 0.0;
  wanted.logging_type = ceres::SILENT;
  wanted.callbacks.push_back(&progress);
  ceres::Solver::Summary summary;
  ceres::Solve(wanted, &all, &summary);
  for (std::size_t i = 0; i < x.size(); ++i)
    if (unknowns.of_pose[i] >= 0 && x[i].allFinite()) made.poses[i] = moved<D>(made.poses[i], x[i]);
  made.ending = summary.termination_type == ceres::CONVERGENCE      ? Ending::Converged
                : summary.termination_type == ceres::USER_SUCCESS   ? Ending::Stopped
                : summary.termination_type == ceres::NO_CONVERGENCE ? Ending::Iterations
                                                                    : Ending::Stuck;
}

}  // namespace

template <int D>
Solution<D> solveByCeres(const Problem<D>& problem, const SolveOptions& options, const std::vector<double>& weights) {
  SolveOptions start_alone = options;
  start_alone.iterations = 0;
  start_alone.progress = {};
  Solution<D> made = solve(problem, start_alone, weights);
  made.iterations.clear();
  if (problem.edges.empty()) return made;
  switch (options.objective) {
    case Objective::Geodesic: descend<Objective::Geodesic>(problem, options, weights, made); break;
    case Objective::Chordal: descend<Objective::Chordal>(problem, options, weights, made); break;
    case Objective::G2o: descend<Objective::G2o>(problem, options, weights, made); break;
  }
  made.cost = cost(problem, made.poses, options.objective, weights);
  made.gradient = isEarly(made.ending) ? gradientNorm(problem, made.poses, options.objective, weights) : 0.0;
  return made;
}

ReferenceSolver ceresSolver() { return {"ceres", solveByCeres<3>}; }

template Solution<2> solveByCeres(const Problem<2>&, const SolveOptions&, const std::vector<double>&);
template Solution<3> solveByCeres(const Problem<3>&, const SolveOptions&, const std::vector<double>&);

}  // namespace pose_graph
