// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

namespace urban_nav::bench {

/// A started camera of the bus with a simulated clock, which advances to the time it waits for. Frames are in memory;
/// passing one on costs one copy, as with a ring buffer.
struct CameraSession {
  std::string name;
  double period = 0.0;  ///< s between frames
  /// Runs until `frames` frames have been sent since the start. Returns the number of frames passed on in this call.
  std::function<int(int frames)> run_until;
};

/// Calls `visit` with each of the two cameras of the robot: 20 pairs per second, and a panorama every 0.3 s.
void forEachCamera(const std::function<void(const CameraSession&)>& visit);

}  // namespace urban_nav::bench
