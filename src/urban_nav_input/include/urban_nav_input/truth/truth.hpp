// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "urban_nav_input/session/open.hpp"
#include "urban_nav_input/session/sessions.hpp"
#include "urban_nav_input/truth/trajectory_file.hpp"

namespace urban_nav_input {

/// Returns the ground truth of an input (poses.txt, state_groundtruth_estimate0, ground_truth/pose) as poses of
/// base_link; nullopt without one. Called after the estimate is finished, so that it cannot use the truth. Throws
/// UserError if it cannot be read.
std::optional<TrajectoryFile> findTruth(const InputSession& session, const SourceInfo& info,
                                        const SourceOptions& options);

/// Returns ground truth from a file as poses of base_link: lines without stamps are poses of the left camera at
/// `stamps`, one per frame.
TrajectoryFile truthOfBase(const TrajectoryFile& file, const SourceInfo& info,
                           const std::vector<urban_nav_core::StampNs>& stamps);

}  // namespace urban_nav_input
