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
/// (right), calib.txt, times.txt, and poses.txt (left camera, relative to the first frame). Frames that the faults drop
/// are not counted, images that are missing are missing files. Each file appears whole or not at all, poses.txt last:
/// a folder without it was cut off. Returns how many frames were written. Throws UserError if the folder is not empty.
int writeSequenceFolder(RenderedSequence& sequence, int frames, FaultFilter faults, const std::string& folder,
                        const std::function<void(int frame)>& progress = {});

/// A piece of such a folder in memory, be it drawn or taken by a real camera.
struct Recording {
  StereoCamera camera;
  std::vector<StereoFrame> frames;
  std::vector<Pose> truth;  ///< left camera in that of the first frame here, one per frame
};
/// The first `frames` frames of a sequence.
Recording record(RenderedSequence& sequence, int frames);
/// At most `count` frames of a folder from `first` on; a missing file is a missing image. Throws UserError naming the
/// file where calib.txt, times.txt or poses.txt is absent or broken, or where there is no such frame.
Recording readSequenceFolder(const std::string& folder, std::size_t first = 0, std::size_t count = 1'000'000);

/// A folder of the data that tests are run against: URBAN_NAV_DATA/`name`. Empty where the variable is not set or there
/// is no such folder: such a test says so and is skipped.
std::string dataFolder(const std::string& name);

}  // namespace urban_nav_core::testing
