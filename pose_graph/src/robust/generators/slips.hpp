// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pose_graph/robust.hpp"

namespace pose_graph {

/// A step of odometry contradicted by the other edges, and the motion that these imply.
template <int D>
struct Slip {
  int edge = 0;
  Rigid<D> T_from_to;
};

/// Returns whether a step of odometry may have slipped, given a relaxed set of edges. Either a step is outside its
/// covariance, or at least two more rows of closures that span it (`row`: by edge, one representative closure) are
/// outside the set than inside, and two of them agree to ten deviations on the motion of the step. Only closures in
/// `considered` count.
template <int D>
bool maySlip(const Problem<D>& problem, const std::vector<EdgeRole>& roles, const std::vector<char>& in,
             const std::vector<char>& considered, const std::vector<int>& row, const std::vector<Rigid<D>>& poses);

/// Returns the steps, by edge, that have the largest excess of rejected over accepted spanning closures; empty if that
/// excess is small. Arguments as in maySlip().
template <int D>
std::vector<char> mostContradicted(const Problem<D>& problem, const std::vector<EdgeRole>& roles,
                                   const std::vector<char>& in, const std::vector<char>& considered);

/// Finds slipped steps of odometry. All edges, of closures those `considered`, are relaxed under Cauchy's kernel from
/// odometry; a step has slipped if it ends far outside its covariance and much farther than others. If several steps
/// are spanned by the same closures, the one that differs from all other steps of the drive is reported. A step that no
/// closure spans cannot be contradicted. `weighted_down`: by edge, steps with almost no weight at first, so that the
/// closures that span them have full weight initially; may be empty.
template <int D>
std::vector<Slip<D>> findSlips(const Problem<D>& problem, const std::vector<EdgeRole>& roles,
                               const std::vector<char>& considered, const std::vector<char>& weighted_down,
                               const std::vector<Rigid<D>>& odometry);

/// Returns whether accepted edges connect the ends of each slip even without any one row of closures (`row`: by edge,
/// one representative closure). Without such edges nothing contradicts the step, and a single row may result from one
/// pair of similar places.
template <int D>
bool joinEndsWithoutAnyRow(const Problem<D>& problem, const std::vector<EdgeRole>& roles, const std::vector<char>& in,
                           const std::vector<int>& row, const std::vector<Slip<D>>& slips);

}  // namespace pose_graph
