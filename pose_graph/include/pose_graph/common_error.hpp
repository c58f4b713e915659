// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pose_graph/problem.hpp"

namespace pose_graph {

/// An error that edges have in common, such as that of a constant with which all of them were measured.
template <int D>
struct CommonError {
  /// Displacement of each edge's measurement for one standard deviation, in the axes of its pose `from`. Edges beyond
  /// the end have none.
  std::vector<Tangent<D>> of_edge;
};

}  // namespace pose_graph
