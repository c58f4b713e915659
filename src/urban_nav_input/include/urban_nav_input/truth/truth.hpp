// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "urban_nav_input/session/open.hpp"
#include "urban_nav_input/session/sessions.hpp"
#include "urban_nav_input/truth/trajectory_file.hpp"

namespace urban_nav_input {

/// The truth that lies in an input (poses.txt, state_groundtruth_estimate0, ground_truth/pose), as poses of base_link;
/// read when the estimate is finished, so that it cannot reach it. Empty where there is none. UserError where it cannot
/// be read.
std::optional<TrajectoryFile> findTruth(const InputSession& session, const SourceInfo& info,
                                        const SourceOptions& options);

/// A truth given as a file, as poses of base_link: lines without stamps are those of the left camera, frame by frame at
/// `stamps`.
TrajectoryFile truthOfBase(const TrajectoryFile& file, const SourceInfo& info,
                           const std::vector<urban_nav_core::StampNs>& stamps);

}  // namespace urban_nav_input
