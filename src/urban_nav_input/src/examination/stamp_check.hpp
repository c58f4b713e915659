// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_input/examination/finding.hpp"
#include "urban_nav_input/examination/input_info.hpp"

namespace urban_nav_input {

/// Returns defects of the stamps of successive stereo pairs: stamps that do not ascend, gaps, a low rate, uneven
/// intervals.
std::vector<Finding> checkStamps(const std::vector<urban_nav_core::StampNs>& stamps);

/// Returns defects of the rates of IMUs and lasers: a low rate of an IMU, streams with gaps.
std::vector<Finding> checkStreams(const std::vector<StreamInfo>& streams);

}  // namespace urban_nav_input
