// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <vector>

#include "pose_graph/robust.hpp"

namespace pose_graph {

/// A selection is repeated with what follows from it so often at most; on public graphs it settles in two.
constexpr int kRepeats = 3;

/// Verdicts of all edges, and the poses that follow.
template <int D>
struct SelectedEdges {
  std::vector<EdgeAssessment> edges;  ///< chi2 of candidates alone
  std::vector<Rigid<D>> poses;
  double variance = 1.0;
  bool is_too_dense = false;  ///< given up: AdmissionState::is_too_dense
};

/// The inner selection: admits closures by evidence, with the information taken as it is stated (relaxRobust()), over
/// the reduced graph where that pays. Gives up where what is accepted takes more than `most_work`
/// (AcceptedGraph::work()) to factor.
template <int D>
SelectedEdges<D> selectEdges(const Problem<D>& problem, const std::vector<EdgeRole>& roles,
                             double most_work = std::numeric_limits<double>::infinity());

/// Whether closures of a set contradict the rest of it, as a row that errs alike (`row`: by edge, one closure of each)
/// or alone, where the variances are those of `problem`, and their own `own` times larger. Single ones have to be more
/// than a negligible share (Thresholds::kContested): of thousands, one fails the test by chance.
template <int D>
bool contradictsItself(const Problem<D>& problem, const std::vector<EdgeRole>& roles, const std::vector<char>& in,
                       std::vector<Rigid<D>> poses, const std::vector<int>& row, double own);

/// Which closures outside a set fit it, alone and as rows, where the variances are those of `problem`, and their own
/// `own` times larger; there has to be evidence for each.
template <int D>
std::vector<char> findFitting(const Problem<D>& problem, const std::vector<EdgeRole>& roles, std::vector<char> in,
                              std::vector<Rigid<D>> poses, const std::vector<int>& row, double own);

extern template SelectedEdges<2> selectEdges<2>(const Problem<2>&, const std::vector<EdgeRole>&, double);
extern template SelectedEdges<3> selectEdges<3>(const Problem<3>&, const std::vector<EdgeRole>&, double);

extern template bool contradictsItself<2>(const Problem<2>&, const std::vector<EdgeRole>&, const std::vector<char>&,
                                          std::vector<Rigid<2>>, const std::vector<int>&, double);
extern template bool contradictsItself<3>(const Problem<3>&, const std::vector<EdgeRole>&, const std::vector<char>&,
                                          std::vector<Rigid<3>>, const std::vector<int>&, double);
extern template std::vector<char> findFitting<2>(const Problem<2>&, const std::vector<EdgeRole>&, std::vector<char>,
                                                 std::vector<Rigid<2>>, const std::vector<int>&, double);
extern template std::vector<char> findFitting<3>(const Problem<3>&, const std::vector<EdgeRole>&, std::vector<char>,
                                                 std::vector<Rigid<3>>, const std::vector<int>&, double);

}  // namespace pose_graph
