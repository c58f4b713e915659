// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "pose_graph/common_error.hpp"
#include "pose_graph/problem.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace pose_graph {

/// Observability of a relative pose.
enum class Knowledge {
  Full,     ///< `covariance` is valid
  Partial,  ///< unobservable along some directions: `information` is valid, and singular
  None,     ///< the poses are in components that no edge with weight and information connects
};
const char* toString(Knowledge knowledge);

/// Marginal of T_a_b in the convention of all stage outputs: (rho, phi) of [Exp(phi) R, t + rho], in the axes of a.
template <int D>
struct Marginal {
  Knowledge knowledge = Knowledge::None;
  TangentMatrix<D> covariance = TangentMatrix<D>::Zero();   ///< if Full
  TangentMatrix<D> information = TangentMatrix<D>::Zero();  ///< if Partial: zero along free directions
};

/// Returns a covariance for output where one is mandatory: 1e6 m2 and 10 rad2 along free directions
/// (covarianceForDisplay() of urban_nav_core). `length`: m that correspond to one rad.
urban_nav_core::Matrix6d displayed(const Marginal<3>& marginal, double length);

/// Marginal covariances of relaxed poses, (J^T W J)^-1 of the geodesic residuals.
///
/// They are valid if the information of the edges is: errors independent between edges, no false closures, poses at the
/// optimum. The error is the geodesic one for every objective. A rejected edge has weight zero and neither constrains
/// nor connects poses.
///
/// Common errors are consider states (Schmidt 1966). One standard deviation of a common error displaces the poses by x
/// = (J^T W J)^-1 J^T W s, which takes one back-substitution, and each covariance includes x x^T. Derivation:
/// docs/derivations/consider_states.md.
///
/// Cost: one factorisation and one selected inverse, about three solver iterations, for all poses and all pairs joined
/// by an edge. Any other pair takes a traversal of the elimination tree from both poses. Not thread-safe: keeps
/// buffers.
template <int D>
class Marginals {
 public:
  /// `poses`: T_map_i, finite. `weights` as in solve(). If numbers overflow, every pair has Knowledge::None.
  Marginals(const Problem<D>& problem, const std::vector<Rigid<D>>& poses, const std::vector<double>& weights = {},
            const std::vector<CommonError<D>>& common = {});
  ~Marginals();
  Marginals(Marginals&&) noexcept;
  Marginals& operator=(Marginals&&) noexcept;

  /// Returns the first pose of the component of `pose`, or its first fixed pose if it has any.
  int first(int pose) const;
  /// Returns the marginal of T_first_pose; zero for the first pose itself.
  Marginal<D> ofPose(int pose) const { return between(first(pose), pose); }
  Marginal<D> between(int a, int b) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

extern template class Marginals<2>;
extern template class Marginals<3>;

}  // namespace pose_graph
