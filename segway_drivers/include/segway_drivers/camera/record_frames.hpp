// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>

#include "segway_drivers/camera/sim_source.hpp"

namespace segway_drivers {

/// A raw frame sent by a simulated camera.
struct RecordedFrame {
  Bytes bytes;                 ///< of a Ladybug2 without padding
  std::uint32_t sequence = 0;  ///< camera counter in the frame
  TimeNs time = 0;             ///< middle of the exposure, ns
  TimeNs arrival = 0;          ///< ns
  bool corrupt = false;        ///< packets are missing
};

/// Runs a simulated camera through its session and calls `take` for each frame that arrives. The camera is configured
/// as by its driver, and again after each loss. The stepped clock begins at the `recorded` stamp of the first frame:
/// the result is deterministic and obtained without waiting. Ends early once `stop` returns true. Returns the number of
/// frames. Throws DataError if the session has none.
std::int64_t recordFrames(const FrameReader& read, const SimCameraOptions& options,
                          const std::function<void(const RecordedFrame&)>& take, const std::function<bool()>& stop);

}  // namespace segway_drivers
