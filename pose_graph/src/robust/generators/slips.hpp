// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pose_graph/robust.hpp"

namespace pose_graph {

/// A step of odometry that the other edges contradict, and what they say in its place.
template <int D>
struct Slip {
  int edge = 0;
  Rigid<D> T_from_to;
};

/// Whether a step of odometry may have slipped, as a set of edges that is relaxed shows it: it is outside its
/// covariance there, or more rows of closures (`row`: by edge, one closure of each) that span it are outside the set
/// than inside, by two at least, and two of them agree to ten deviations on what the step is instead. Only those of
/// `considered` count.
template <int D>
bool maySlip(const Problem<D>& problem, const std::vector<EdgeRole>& roles, const std::vector<char>& in,
             const std::vector<char>& considered, const std::vector<int>& row, const std::vector<Rigid<D>>& poses);

/// The steps that more of the closures which span them refute than bear out than any others, by edge; none (empty)
/// where hardly any does. As maySlip() otherwise.
template <int D>
std::vector<char> mostRefuted(const Problem<D>& problem, const std::vector<EdgeRole>& roles,
                              const std::vector<char>& in, const std::vector<char>& considered);

/// Steps of odometry that are likely false: all edges but closures that are not `considered` are relaxed under Cauchy's
/// kernel, from where odometry puts the poses, and a step that ends far outside its covariance, and much farther than
/// others do, has slipped. Which of several it was, where the same closures span them, is for their measurements to
/// tell: the one that is like no other step. Steps that no closure spans cannot be refuted. `doubted`, by edge: steps
/// that count next to nothing at first, so that what spans them is trusting to begin with; empty for none.
template <int D>
std::vector<Slip<D>> findSlips(const Problem<D>& problem, const std::vector<EdgeRole>& roles,
                               const std::vector<char>& considered, const std::vector<char>& doubted,
                               const std::vector<Rigid<D>>& odometry);

/// Whether the edges inside join the ends of each slip, also without any one row of closures (`row`: by edge, one
/// closure of each): where none do, nothing contradicts the step, and one row is one place, which may resemble another
/// one.
template <int D>
bool joinEndsWithoutAnyRow(const Problem<D>& problem, const std::vector<EdgeRole>& roles, const std::vector<char>& in,
                           const std::vector<int>& row, const std::vector<Slip<D>>& slips);

}  // namespace pose_graph
