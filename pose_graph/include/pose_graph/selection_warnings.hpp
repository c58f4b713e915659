// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "pose_graph/graph_file.hpp"
#include "pose_graph/robust.hpp"
#include "pose_graph/scales.hpp"

namespace pose_graph {

/// Returns warnings about a selection among `closures` closures, of which `rejected` were rejected, one sentence each:
/// no decision, a rival set, or a graph too large to compare sets.
std::vector<std::string> selectionWarnings(const SelectionReport& selection, std::size_t rejected,
                                           std::size_t closures);

/// Returns warnings about a selection in a file, one sentence each: no decision, more than half of a kind of edge
/// rejected, parts not joined, odometry slips, errors of more than 3 times the stated deviations, or odometry and
/// closures differing by more than that.
template <int D>
std::vector<std::string> selectionWarnings(const FileProblem<D>& file, const RobustSolution<D>& robust,
                                           const DeviationScales& scales);

}  // namespace pose_graph
