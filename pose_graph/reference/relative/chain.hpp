// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "pose_graph/problem.hpp"

namespace pose_graph {

/// The edges of a problem, grouped by their relation to the chain. Edges between consecutive poses, in either direction
/// and any number, depend on one link only: the lower rows of (19). All others are closures: the rows of H.
template <int D>
struct Chain {
  struct LinkEdge {
    int link;          ///< the link from pose link to pose link + 1
    std::size_t edge;  ///< into problem.edges
  };
  struct Closure {
    std::size_t edge;
    TangentMatrix<D> root;  ///< root^T root = information; of any rank
  };
  int links = 0;
  std::vector<LinkEdge> link_edges;  ///< sorted by link, then in the order of the problem; at least one per link
  std::vector<Closure> closures;     ///< in the order of the problem
};

/// Throws UserError as relaxRelative() does.
template <int D>
Chain<D> makeChain(const Problem<D>& problem);

}  // namespace pose_graph
