// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "pose_graph/graph_file.hpp"
#include "pose_graph/robust.hpp"
#include "pose_graph/scales.hpp"

namespace pose_graph {

/// Warnings about a selection among closures, `rejected` of `closures`, a sentence each: nothing could be decided,
/// another set is nearly as likely, or the graph was too large to weigh any.
std::vector<std::string> selectionWarnings(const SelectionReport& selection, std::size_t rejected,
                                           std::size_t closures);

/// Warnings about a selection in a file, a sentence each: nothing could be decided, more than half of a kind of edge is
/// rejected, parts that odometry does not join stay apart, odometry slipped, errors are more than 3 times the
/// deviations that the information states, or odometry's and the closures' differ by more than that.
template <int D>
std::vector<std::string> selectionWarnings(const FileProblem<D>& file, const RobustSolution<D>& robust,
                                           const DeviationScales& scales);

}  // namespace pose_graph
