// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "checks/finding.hpp"
#include "inspect/input_info.hpp"
#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav {

/// Returns what is wrong with the stamps of successive stereo pairs: stamps that do not ascend, gaps, a low rate,
/// intervals that are not even.
std::vector<Finding> checkStamps(const std::vector<urban_nav_core::StampNs>& stamps);

/// Returns what is wrong with the rates of inertial units and lasers: an IMU that is too slow, streams with gaps.
std::vector<Finding> checkStreams(const std::vector<StreamInfo>& streams);

}  // namespace urban_nav
