// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "loop_metric/stereo_closure.hpp"

namespace loop_metric::bench {

/// The two views side by side with their matches, agreeing ones green, the others red; a PNG.
void drawMatches(const Keyframe& a, const Keyframe& b, const StereoClosure& closure, const std::string& path);

}  // namespace loop_metric::bench
