// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "urban_nav_sim/device/simulated_device.hpp"
#include "urban_nav_sim/session.hpp"

namespace urban_nav {

struct SimulateCameraJob {
  std::string kind;  ///< bumblebee2, ladybug2
  std::string bag;   ///< recorded session; empty: `session` is simulated
  urban_nav_sim::SessionOptions session;
  std::string source;  ///< raw frames one after another; `SOURCE.csv` is their index
  std::string truth;   ///< file of `sequence,true_ns`, or empty
  urban_nav_sim::DeviceOptions options;
};

bool isCamera(const std::string& kind);

/// Writes the raw frames of a simulated camera, as received from the bus, and their index
/// `offset,arrival_ns,sequence,bytes,corrupt`. Times are those of the recording; does not run in real time. Ends early
/// once `stop` returns true. Returns the number of frames. Throws UserError for faults that do not apply to cameras and
/// for an unreadable bag, DataError if it has no images of the camera.
std::int64_t simulateCamera(const SimulateCameraJob& job, const std::function<bool()>& stop);

}  // namespace urban_nav
