// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "training/matched_run.hpp"

namespace fabmap_node {

using DescribedDrive = std::vector<DescribedPlace>;

/// Returns labelled matches of both kinds from drives at different places; see trainModel(). Requires at least three
/// drives of one vocabulary of `words`, with the same number of cameras.
CalibrationRuns calibrationRuns(const std::vector<DescribedDrive>& drives, std::size_t words, const Detector& detector,
                                const MatcherOptions& options, const std::function<void(double share)>& progress);

}  // namespace fabmap_node
