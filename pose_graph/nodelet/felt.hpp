// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pose_graph/level.hpp"

namespace pose_graph {

/// An accelerometer's samples on their way to the poses of a session, which come later than they do. A pose's mean is final when the
/// samples are ten seconds ahead of it; samples are kept for ten minutes.
class Felt {
 public:
  /// One that lies more than a second back is of a recording that began again: it is for the session that begins next.
  void add(const SpecificForce& sample);
  /// A session begins, of which no pose has been seen.
  void begin();
  /// At poses of the session, from the first one on whose mean was not final yet (forcesAt). `stamps`: all of its poses.
  std::vector<SpecificForce> at(const std::vector<urban_nav_core::StampNs>& stamps);

 private:
  std::vector<SpecificForce> samples_, next_session_;
  std::size_t open_ = 0;  ///< the first pose whose mean is not final
};

}  // namespace pose_graph
