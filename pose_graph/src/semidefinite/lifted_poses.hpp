// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "pose_graph/problem.hpp"

namespace pose_graph {

/// Poses near the global optimum of the chordal objective, found where knots come undone: with rotations of eight
/// dimensions, of which D columns each are kept (R_i with orthonormal columns in R^8), there is room to turn around
/// what is an obstacle in the plane or in space, and hardly any local minimum is left (Burer, Monteiro, Math. Program.
/// 2003; Boumal, Voroninski, Bandeira, NeurIPS 2016; Rosen et al., SE-Sync, IJRR 2019, section 4). The minimum found
/// there is laid back into the D dimensions that hold most of it.
///
/// Riemannian Newton steps by conjugate gradients within a trust region (Absil, Baker, Gallivan, Found. Comput. Math.
/// 2007), preconditioned by one factorisation of the quadratic form. `start` is any guess; what it leaves out of the D
/// dimensions comes from a fixed sequence of numbers. The first pose of each part of the graph stays where `start` has
/// it. Empty where the numbers fail. `weights` as in cost().
template <int D>
std::optional<std::vector<Rigid<D>>> liftedPoses(const Problem<D>& problem, const std::vector<Rigid<D>>& start,
                                                 const std::vector<double>& weights);

extern template std::optional<std::vector<Rigid<2>>> liftedPoses(const Problem<2>&, const std::vector<Rigid<2>>&,
                                                                 const std::vector<double>&);
extern template std::optional<std::vector<Rigid<3>>> liftedPoses(const Problem<3>&, const std::vector<Rigid<3>>&,
                                                                 const std::vector<double>&);

}  // namespace pose_graph
