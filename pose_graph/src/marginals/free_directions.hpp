// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose_graph/marginals.hpp"

namespace pose_graph {

/// Converts a covariance computed with pins to a marginal. `pinned`: the covariance; `free`: its part that is due to
/// the pins only, twice the difference between pins and pins of double strength, since everything determined by edges
/// does not depend on the pins.
template <int D>
Marginal<D> withoutPins(const TangentMatrix<D>& pinned, const TangentMatrix<D>& free);

}  // namespace pose_graph
