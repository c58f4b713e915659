// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pose_graph/robust.hpp"

namespace pose_graph {

/// Number of consistent closures that join two parts if their total evidence suffices but pairwise tests do not.
constexpr std::size_t kLeastWeakLink = 3;

/// Closures that place one part of a graph in the frame of another.
struct SessionLinks {
  std::vector<int> agreed;    ///< one for each pair of parts to join
  std::vector<int> doubtful;  ///< between parts that pairwise tests do not join; the best supported first
};

/// Returns the part of each pose: parts are connected by trusted and asserted edges.
template <int D>
std::vector<int> sessionParts(const Problem<D>& problem, const std::vector<EdgeRole>& roles);

/// Finds links between parts that no accepted edge joins, as sets of pairwise consistent closures between two parts
/// (Mangelson, Dominic, Eustice, Vasudevan, Pairwise consistent measurement set maximization, ICRA 2018). k of N
/// closures join if C(N, k) p^(k-1) < 0.01, with p the probability that two random closures are consistent on this map;
/// a single closure does not, nor do two of one row. If odometry is so uncertain that almost all pairs are consistent,
/// the best supported closures are doubtful links, to be decided by the evidence of all closures that are consistent
/// with one of them. Large sets are subsampled. The parts have the shape given by `poses` and the accepted edges `in`.
template <int D>
SessionLinks linkSessions(const Problem<D>& problem, const std::vector<EdgeRole>& roles, const std::vector<char>& in,
                          const std::vector<Rigid<D>>& poses);

extern template std::vector<int> sessionParts<2>(const Problem<2>&, const std::vector<EdgeRole>&);
extern template std::vector<int> sessionParts<3>(const Problem<3>&, const std::vector<EdgeRole>&);
extern template SessionLinks linkSessions<2>(const Problem<2>&, const std::vector<EdgeRole>&, const std::vector<char>&,
                                             const std::vector<Rigid<2>>&);
extern template SessionLinks linkSessions<3>(const Problem<3>&, const std::vector<EdgeRole>&, const std::vector<char>&,
                                             const std::vector<Rigid<3>>&);

}  // namespace pose_graph
