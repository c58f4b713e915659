// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "fabmap_node/model/place_model.hpp"
#include "fabmap_node/recognition/place_matcher.hpp"
#include "fabmap_node/training/prior_choice.hpp"
#include "urban_nav_core/types/stamp.hpp"

namespace fabmap_node {

struct LocatedImage {
  urban_nav_core::StampNs stamp = 0;
  PlaceObservation observation;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< m, in a frame that all days of the site share
  Eigen::Vector3d forward = Eigen::Vector3d::UnitX();  ///< direction of the robot in that frame, a unit vector
};
/// Observations of one day in order of time, with positions.
using LocatedDay = std::vector<LocatedImage>;
/// Days at one site.
using LocatedSite = std::vector<LocatedDay>;

/// Prior of one of the calibrations of a model.
struct CalibrationPrior {
  std::string calibration;  ///< "panoramas in sequence", ...
  PriorChoice choice;
};

struct RecalibrationReport {
  std::size_t right = 0, wrong = 0;  ///< samples of each kind
  std::vector<CalibrationPrior> priors;
};

/// Fits the calibrations of a model anew, with days at sites that the model was not trained with: light and weather
/// change between days, and other sites of the same kind look alike, which drives of `places train` do not show.
///
/// Each observation is compared with the places of its own day (the first of each site), of each day before it at its
/// site, of both without those nearer than 10 m, and of all other sites. A match within 7.5 m is right, beyond 10 m
/// wrong. These situations count the same, as do right and wrong matches; sequences, which count between sessions only,
/// are calibrated without the first. choosePrior() finds the prior of each calibration. Panoramas calibrate single
/// images too, with their first cameras; between days, those are right within 3 m in the same direction. Throws
/// UserError if no site has two days, or if there are no samples of one kind.
RecalibrationReport recalibrate(PlaceModel& model, const std::vector<LocatedSite>& sites,
                                const MatcherOptions& options);

}  // namespace fabmap_node
