// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pose_graph/robust.hpp"

namespace pose_graph {

/// A graph in which edges that are the same to the last bit count once: they are no independent measurements.
template <int D>
struct UniqueEdges {
  Problem<D> problem;
  std::vector<EdgeRole> roles;
  std::vector<int> of_edge;  ///< by edge of the whole graph
};

template <int D>
UniqueEdges<D> uniqueEdges(const Problem<D>& problem, const std::vector<EdgeRole>& roles);

extern template UniqueEdges<2> uniqueEdges<2>(const Problem<2>&, const std::vector<EdgeRole>&);
extern template UniqueEdges<3> uniqueEdges<3>(const Problem<3>&, const std::vector<EdgeRole>&);

}  // namespace pose_graph
