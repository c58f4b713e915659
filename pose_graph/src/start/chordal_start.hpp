// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "solve/normal_equations.hpp"

namespace pose_graph {

/// Estimates rotations without an initial guess. R_i as free DxD matrices minimise sum kappa |R_j - R_i R_ij|^2, a
/// linear problem, and each is projected to the nearest rotation (Martinec, Pajdla, CVPR 2007; Carlone et al., ICRA
/// 2015, "chordal relaxation"). No path is followed, so no rotation error can accumulate. Held poses keep their
/// rotation in `poses`. Returns nullopt if the edges do not determine the rotations.
template <int D>
std::optional<std::vector<Rotation<D>>> chordalRotations(const NormalEquations<D>& equations,
                                                         const std::vector<Rigid<D>>& poses,
                                                         const std::vector<double>& weights);

/// Returns the poses with the translations that best fit these rotations: linear least squares with the edges'
/// translation information. Held poses keep their values. Returns nullopt if the edges do not determine the
/// translations.
template <int D>
std::optional<std::vector<Rigid<D>>> translationsFor(const NormalEquations<D>& equations,
                                                     const std::vector<Rotation<D>>& rotations,
                                                     const std::vector<Rigid<D>>& poses,
                                                     const std::vector<double>& weights);

}  // namespace pose_graph
