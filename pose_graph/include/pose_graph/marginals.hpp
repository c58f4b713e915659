// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "pose_graph/common_error.hpp"
#include "pose_graph/problem.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace pose_graph {

/// What the edges tell of a relative pose.
enum class Knowledge {
  Full,     ///< `covariance`
  Partial,  ///< no edge says anything along some directions: `information`, singular
  None,     ///< the two are in parts that no edge with weight and information connects
};
const char* toString(Knowledge knowledge);

/// Of T_a_b, as everything that leaves a stage: (rho, phi) of [Exp(phi) R, t + rho], in the axes of a.
template <int D>
struct Marginal {
  Knowledge knowledge = Knowledge::None;
  TangentMatrix<D> covariance = TangentMatrix<D>::Zero();   ///< where Full
  TangentMatrix<D> information = TangentMatrix<D>::Zero();  ///< where Partial: zero along what is free
};

/// A covariance to be shown or written where there must be one: 1e6 m2 and 10 rad2 along directions that are free
/// (covarianceForDisplay of the core; `length`: the m that weigh as much as one rad).
urban_nav_core::Matrix6d displayed(const Marginal<3>& marginal, double length);

/// Marginal covariances of relaxed poses, (J^T W J)^-1 of the geodesic residuals.
///
/// They are as true as the edges' information is: errors independent from edge to edge, of that size, no false closure
/// among them, and poses at the optimum. Whatever the objective was that led there, the error is the geodesic one. A
/// rejected edge has the weight zero: it then says nothing and connects nothing.
///
/// Common errors are consider states (Schmidt 1966): one standard deviation of them displaces the poses by
/// x = (J^T W J)^-1 J^T W s, one back-substitution each, and every covariance contains x x^T. Derivation:
/// docs/derivations/consider_states.md.
///
/// One factorisation and one selected inverse, about three times what an iteration of the solver takes, for all poses
/// and for all pairs that an edge joins; another pair costs a walk from both up the elimination tree. Keeps buffers:
/// not thread-safe.
template <int D>
class Marginals {
 public:
  /// `poses` are T_map_i, finite; `weights` as in solve(). Where numbers overflow, nothing is known of any pair.
  Marginals(const Problem<D>& problem, const std::vector<Rigid<D>>& poses, const std::vector<double>& weights = {},
            const std::vector<CommonError<D>>& common = {});
  ~Marginals();
  Marginals(Marginals&&) noexcept;
  Marginals& operator=(Marginals&&) noexcept;

  /// The first pose of the part that a pose belongs to, or the first fixed one where the part has any.
  int first(int pose) const;
  /// Of T_first_pose; that of the first itself is zero.
  Marginal<D> ofPose(int pose) const { return between(first(pose), pose); }
  Marginal<D> between(int a, int b) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

extern template class Marginals<2>;
extern template class Marginals<3>;

}  // namespace pose_graph
