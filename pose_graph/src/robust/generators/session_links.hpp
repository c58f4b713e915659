// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pose_graph/robust.hpp"

namespace pose_graph {

/// So many closures that agree join two parts where they are evidence as a whole, but not pair by pair.
constexpr std::size_t kLeastWeakLink = 3;

/// Closures that put one part of a graph in the frame of another.
struct SessionLinks {
  std::vector<int> agreed;    ///< one between each two parts that join
  std::vector<int> doubtful;  ///< between parts that pairs alone do not join; best supported first
};

/// Parts of a graph that trusted and asserted edges hold together: which part each pose is of.
template <int D>
std::vector<int> sessionParts(const Problem<D>& problem, const std::vector<EdgeRole>& roles);

/// Joins parts of a graph that no accepted edge joins, by sets of closures between two parts that are pairwise
/// consistent (Mangelson, Dominic, Eustice, Vasudevan, Pairwise consistent measurement set maximization, ICRA 2018).
/// k of N closures join where C(N, k) p^(k-1) < 0.01, p the probability that two random ones agree on this very map;
/// one never does, nor two of one row. Where odometry is so uncertain that hardly any pair disagrees, the closures that
/// others support best are doubtful links: the evidence of all that agree once one of them holds has to decide. Of very
/// many, some are looked at. The parts are taken as `poses` and the edges that are `in` have them.
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
