// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose_graph/marginals.hpp"

namespace pose_graph {

/// What is known of N numbers whose covariance under pins is `pinned`, and of that the part `free` is the pins' alone:
/// twice the difference between pins and pins of double strength, since everything that edges determine does not depend
/// on them.
template <int D>
Marginal<D> withoutPins(const TangentMatrix<D>& pinned, const TangentMatrix<D>& free);

}  // namespace pose_graph
