// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <vector>

#include "pose_graph/robust.hpp"

namespace pose_graph {

/// Limit of repetitions of a selection with its own result; public graphs need two.
constexpr int kRepeats = 3;

/// Verdicts of all edges, and the relaxed poses.
template <int D>
struct SelectedEdges {
  std::vector<EdgeAssessment> edges;  ///< chi2 is set for candidates only
  std::vector<Rigid<D>> poses;
  double variance = 1.0;
  bool is_too_dense = false;  ///< aborted, see AdmissionState::is_too_dense
};

/// The inner selection: admits closures by evidence with the stated information (relaxRobust()), using the reduced
/// graph where that is faster. Aborts if AcceptedGraph::work() of the accepted edges exceeds `most_work`.
template <int D>
SelectedEdges<D> selectEdges(const Problem<D>& problem, const std::vector<EdgeRole>& roles,
                             double most_work = std::numeric_limits<double>::infinity());

/// Returns whether closures of a set contradict the rest of it, as a row with a common error (`row`: by edge, one
/// representative closure) or individually. Variances are those of `problem`, those of the tested closures larger by
/// the factor `own`. Individual contradictions count above a share of Thresholds::kContested, since among thousands one
/// fails by chance.
template <int D>
bool contradictsItself(const Problem<D>& problem, const std::vector<EdgeRole>& roles, const std::vector<char>& in,
                       std::vector<Rigid<D>> poses, const std::vector<int>& row, double own);

/// Returns which closures outside a set fit it, individually and as rows, with sufficient evidence each. Variances are
/// those of `problem`, those of the tested closures larger by the factor `own`.
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
