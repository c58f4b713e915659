// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "fabmap_node/model/place_model.hpp"
#include "fabmap_node/recognition/place_matcher.hpp"
#include "urban_nav_core/types/stamp.hpp"

namespace fabmap_node {

struct LocatedImage {
  urban_nav_core::StampNs stamp = 0;
  PlaceObservation observation;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< m, in a frame that all days share
};
/// Observations of one day in order of time, with positions.
using LocatedDay = std::vector<LocatedImage>;

struct RecalibrationReport {
  std::size_t right = 0, wrong = 0;  ///< samples of each kind
};

/// Fits the calibrations of a model anew, with several days at one place that the model was not trained with: light and
/// weather change between them, which neighbours in one drive do not show.
///
/// Each observation is compared with each day. A match within 7.5 m is right, beyond 10 m wrong. Each observation is
/// also compared with the places beyond 10 m alone, as one at a new place is. Days of panoramas calibrate single images
/// too, with their first cameras. Throws UserError if there are fewer than two days, or no samples of one kind.
RecalibrationReport recalibrate(PlaceModel& model, const std::vector<LocatedDay>& days, const MatcherOptions& options);

}  // namespace fabmap_node
