// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "swf_vo/swf_vo.hpp"
#include "urban_nav_core/testing/faults.hpp"
#include "urban_nav_core/testing/sequence_folder.hpp"

namespace swf_vo {

/// What the filter says of a frame that arrived.
struct Played {
  std::size_t index;   ///< of it in the recording
  int since;           ///< frames that arrived since the fault began: 0 for the first, -1 before
  const Frame& frame;  ///< lives until the next
};

/// What wheels say from one frame of a recording to another.
using Wheels = std::function<std::vector<urban_nav_core::MotionInput>(std::size_t from, std::size_t to)>;

/// A recording with one fault on it (parseFault) through a filter; `see` gets a Played for each frame that arrives.
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
