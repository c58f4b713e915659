// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "window/sensor_model.hpp"
#include "window/state.hpp"

namespace swf_vo {

/// Finds landmarks that violate the static-world assumption. Where the edge of a near object crosses the background,
/// the images show a corner that is not a point of the scene: it drifts as the camera moves, by a few hundredths of a
/// pixel per frame, too little to be detected in a single measurement. Over all frames of the window it is detectable:
/// the root mean square residual, in standard deviations of the alignments, is far from that of the other landmarks
/// (median and median absolute deviation).
class DriftingLandmarks {
 public:
  /// Returns the landmarks to be dropped, after an update; valid until the next call.
  const std::vector<LandmarkId>& find(const State& state, const SensorModel& sensor);

 private:
  bool score(const State& state, const SensorModel& sensor, const LandmarkBlock& landmark);

  struct Score {
    LandmarkId landmark;
    double residual;
  };
  std::vector<Score> scores_;
  std::vector<double> sorted_;
  std::vector<LandmarkId> drifting_;
};

}  // namespace swf_vo
