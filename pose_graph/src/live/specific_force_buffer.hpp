// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pose_graph/level.hpp"

namespace pose_graph {

/// Buffers accelerometer samples until the delayed poses of a session arrive. The mean at a pose is final once samples
/// are ten seconds ahead of it. Samples are kept for ten minutes.
class SpecificForceBuffer {
 public:
  /// Adds a sample. A sample whose stamp jumps back belongs to the next session.
  void add(const SpecificForce& sample);
  /// Returns whether no sample has been added yet.
  bool empty() const { return samples_.empty() && next_session_.empty(); }
  /// Begins a session without poses.
  void beginSession();
  /// Returns the means at the session's poses (forcesAt()), from the first one that was not final in the previous call.
  /// `stamps`: of all its poses.
  std::vector<SpecificForce> meansAt(const std::vector<urban_nav_core::StampNs>& stamps);

 private:
  std::vector<SpecificForce> samples_, next_session_;
  std::size_t open_ = 0;  ///< first pose whose mean is not final
};

}  // namespace pose_graph
