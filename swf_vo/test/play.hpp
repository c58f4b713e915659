// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "swf_vo/swf_vo.hpp"
#include "urban_nav_core/testing/faults.hpp"
#include "urban_nav_core/testing/sequence_folder.hpp"

namespace swf_vo {

/// Result of the filter for a frame.
struct Played {
  std::size_t index;   ///< index in the recording
  int since;           ///< frames since the fault began: 0 for the first, -1 before
  const Frame& frame;  ///< valid until the next frame
};

/// Wheel measurements between two frames of a recording.
using Wheels = std::function<std::vector<urban_nav_core::MotionInput>(std::size_t from, std::size_t to)>;

/// Runs a recording with one fault (parseFault) through a filter; `see` is called with a Played for each frame.
template <typename See>
void playWithFault(const urban_nav_core::testing::Recording& recording, const std::string& what, const See& see,
                   const Parameters& parameters = Parameters(), const Wheels& wheels = {}) {
  const urban_nav_core::testing::Fault fault = urban_nav_core::testing::parseFault(what);
  urban_nav_core::testing::FaultFilter faults({fault}, 1);
  SwfVo filter(parameters, recording.camera, urban_nav_core::Pose());
  bool begun = false;
  int since = -1;
  std::size_t last = 0;
  for (std::size_t i = 0; i < recording.frames.size(); ++i) {
    begun = begun || fault.isActive(recording.frames[i].stamp - recording.frames.front().stamp);
    const auto arrived = faults.apply(recording.frames[i]);
    if (!arrived) continue;
    if (begun) ++since;
    const auto inputs = wheels && i > 0 ? wheels(last, i) : std::vector<urban_nav_core::MotionInput>();
    see(Played{i, since, filter.process(arrived->pair(), inputs)});
    last = i;
  }
}

}  // namespace swf_vo
