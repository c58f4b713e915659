// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pose_graph/problem.hpp"

namespace pose_graph {

/// An error common to several edges, such as that of a calibration constant with which all of them were measured.
template <int D>
struct CommonError {
  /// Displacement of each edge's measurement per standard deviation, in the axes of its pose `from` (m, rad). Edges
  /// past the end of the vector are not affected.
  std::vector<Tangent<D>> of_edge;
};

}  // namespace pose_graph
