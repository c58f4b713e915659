// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "solve/normal_equations.hpp"

namespace pose_graph {

/// Rotations without a first guess: R_i as free DxD matrices minimise sum kappa |R_j - R_i R_ij|^2, which is linear,
/// and each is then replaced by the rotation nearest to it (Martinec, Pajdla, CVPR 2007; Carlone et al., ICRA 2015,
/// "chordal relaxation"). It undoes knots: no path is followed, so none can be wrong. Poses that are held keep their
/// rotation. `poses` gives those. Empty where the edges do not determine the rotations.
template <int D>
std::optional<std::vector<Rotation<D>>> chordalRotations(const NormalEquations<D>& equations,
                                                         const std::vector<Rigid<D>>& poses,
                                                         const std::vector<double>& weights);

/// The translations that fit these rotations best: linear least squares with the edges' information of translations.
/// Poses that are held stay. Empty where the edges do not determine them.
template <int D>
std::optional<std::vector<Rigid<D>>> translationsFor(const NormalEquations<D>& equations,
                                                     const std::vector<Rotation<D>>& rotations,
                                                     const std::vector<Rigid<D>>& poses,
                                                     const std::vector<double>& weights);

}  // namespace pose_graph
