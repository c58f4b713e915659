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
/// An observation with the pose at which it was made.
struct LocatedImage {
  urban_nav_core::StampNs stamp = 0;
  PlaceObservation observation;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< m, in a frame common to all days of the site
  Eigen::Vector3d forward = Eigen::Vector3d::UnitX();  ///< viewing direction of the robot in that frame, a unit vector
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
/// Sizes and priors of a recalibration.
struct RecalibrationReport {
  std::size_t right = 0, wrong = 0;  ///< numbers of samples of each kind
  std::vector<CalibrationPrior> priors;
};

/// Refits the calibrations of a model with days at sites that were not used to train it, which include changes of light
/// and weather between days and similar places at other sites, unlike the drives of `places train`.
///
/// Each observation is compared with the places of its own day (the first of each site), of each earlier day at its
/// site, of that day and all other sites, of its site without the places nearer than 10 m, of all other sites, and of
/// the other site that resembles its own most (first days only). A match within 7.5 m is correct, beyond 10 m wrong.
/// These situations have equal weights, as do correct and wrong matches; sequences, which are used only between
/// sessions, are calibrated without the first situation. choosePrior() selects the prior of each calibration. Panoramas
/// also calibrate single images, with their first cameras; between days, those are correct within 3 m in the same
/// direction. Throws UserError if no site has two days, or if there are no samples of one kind.
RecalibrationReport recalibrate(PlaceModel& model, const std::vector<LocatedSite>& sites,
                                const MatcherOptions& options);

}  // namespace fabmap_node
