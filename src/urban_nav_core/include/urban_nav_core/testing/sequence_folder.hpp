// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "urban_nav_core/testing/faults.hpp"
#include "urban_nav_core/testing/rendered_sequence.hpp"

namespace urban_nav_core::testing {

/// Writes the first `frames` frames of a sequence as a folder of KITTI odometry: image_0/%06d.png (left), image_1
/// (right), calib.txt, times.txt, and poses.txt (left camera, relative to the first frame). Frames that the faults drop
/// are not counted, images that are missing are missing files. Each file appears whole or not at all, poses.txt last:
/// a folder without it was cut off. Returns how many frames were written. Throws UserError if the folder is not empty.
int writeSequenceFolder(RenderedSequence& sequence, int frames, FaultFilter faults, const std::string& folder,
                        const std::function<void(int frame)>& progress = {});

}  // namespace urban_nav_core::testing
