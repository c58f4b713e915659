// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_input/examination/finding.hpp"
#include "urban_nav_input/examination/input_info.hpp"

namespace urban_nav_input {

/// Returns what is wrong with the stamps of successive stereo pairs: stamps that do not ascend, gaps, a low rate,
/// intervals that are not even.
std::vector<Finding> checkStamps(const std::vector<urban_nav_core::StampNs>& stamps);

/// Returns what is wrong with the rates of inertial units and lasers: an IMU that is too slow, streams with gaps.
std::vector<Finding> checkStreams(const std::vector<StreamInfo>& streams);

}  // namespace urban_nav_input
