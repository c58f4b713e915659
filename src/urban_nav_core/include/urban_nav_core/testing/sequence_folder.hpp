// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/testing/faults.hpp"
#include "urban_nav_core/testing/rendered_sequence.hpp"

namespace urban_nav_core::testing {

/// Writes the first `frames` frames of a sequence as a folder of KITTI odometry: image_0/%06d.png (left), image_1
/// (right), calib.txt, times.txt, and poses.txt (left camera, relative to the first frame). Frames dropped by faults
/// are not counted; missing images are missing files. Each file is written atomically, poses.txt last: without it the
/// folder is incomplete. Returns the number of frames written. Throws UserError if the folder is not empty.
int writeSequenceFolder(RenderedSequence& sequence, int frames, FaultFilter faults, const std::string& folder,
                        const std::function<void(int frame)>& progress = {});

/// Part of such a folder in memory, rendered or recorded by a camera.
struct Recording {
  StereoCamera camera;
  std::vector<StereoFrame> frames;
  std::vector<Pose> truth;  ///< left camera relative to the first frame here, one per frame
};
/// Returns the first `frames` frames of a sequence.
Recording record(RenderedSequence& sequence, int frames);
/// Reads at most `count` frames of a folder from `first` on; a missing file is a missing image. Throws UserError naming
/// the file if calib.txt, times.txt or poses.txt is missing or invalid, or if there is no such frame.
Recording readSequenceFolder(const std::string& folder, std::size_t first = 0, std::size_t count = 1'000'000);

/// Returns the folder of test data URBAN_NAV_DATA/`name`; empty if the variable is not set or the folder does not
/// exist, in which case the test is skipped with a message.
std::string dataFolder(const std::string& name);

}  // namespace urban_nav_core::testing
