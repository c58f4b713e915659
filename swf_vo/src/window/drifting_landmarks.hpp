// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "window/sensor_model.hpp"
#include "window/state.hpp"

namespace swf_vo {

/// Finds landmarks that violate the static-world assumption. Where the edge of something near crosses what lies beyond
/// it, the images show a corner that is no point of the scene: it slides as the camera moves, by a few hundredths of a
/// pixel per frame, too little for any single measurement to stand out. What it leaves over all the frames of the
/// window does: its root mean square residual, in standard deviations of its alignments, is far from that of the others
/// (median and median deviation).
class DriftingLandmarks {
 public:
  /// Landmarks to be given up, after an update; lives until the next call.
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
