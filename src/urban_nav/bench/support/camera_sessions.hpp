// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

namespace urban_nav::bench {

/// A camera of the bus, started, on a clock that steps to where it waits for. Its frames lie in memory: what it takes
/// to hand one out is the copy that a ring of buffers costs too.
struct CameraSession {
  std::string name;
  double period = 0.0;  ///< s between frames
  /// Goes on until so many frames have been sent since the start; gives how many were handed out meanwhile.
  std::function<int(int frames)> run_until;
};

/// Calls `visit` with the robot's two cameras, one after the other: 20 pairs a second, and a panorama each 0.3 s.
void forEachCamera(const std::function<void(const CameraSession&)>& visit);

}  // namespace urban_nav::bench
