// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "pose_graph/problem.hpp"

namespace pose_graph {

/// Returns poses near the global optimum of the chordal objective. Rotations are lifted to eight dimensions, keeping D
/// columns each (R_i with orthonormal columns in R^8). There, wrap-arounds of rotations are no obstacle, and few local
/// minima remain (Burer, Monteiro, Math. Program. 2003; Boumal, Voroninski, Bandeira, NeurIPS 2016; Rosen et al.,
/// SE-Sync, IJRR 2019, section 4). The minimum is projected to the D dimensions with most of its energy.
///
/// Method: Riemannian trust region with truncated conjugate gradients (Absil, Baker, Gallivan, Found. Comput. Math.
/// 2007), preconditioned by one factorisation of the quadratic form. `start`: any initial guess; its components in the
/// additional dimensions are a fixed pseudorandom sequence. The first pose of each component keeps its value in
/// `start`. Returns nullopt if the computation is not finite. `weights` as in cost().
template <int D>
std::optional<std::vector<Rigid<D>>> liftedPoses(const Problem<D>& problem, const std::vector<Rigid<D>>& start,
                                                 const std::vector<double>& weights);

extern template std::optional<std::vector<Rigid<2>>> liftedPoses(const Problem<2>&, const std::vector<Rigid<2>>&,
                                                                 const std::vector<double>&);
extern template std::optional<std::vector<Rigid<3>>> liftedPoses(const Problem<3>&, const std::vector<Rigid<3>>&,
                                                                 const std::vector<double>&);

}  // namespace pose_graph
