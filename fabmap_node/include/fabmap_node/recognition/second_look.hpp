// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "fabmap_node/features/place_observation.hpp"

namespace fabmap_node {

inline constexpr int kLookElements = 64;
/// Descriptors of a second look: neighbouring directions of the gradient are added up, so that twice as many fit.
using LookDescriptors = Eigen::Matrix<float, kLookElements, Eigen::Dynamic>;

/// What a second look compares: descriptors of an observation with their directions.
struct LookFeatures {
  std::uint8_t cameras = 1;
  LookDescriptors descriptors;              ///< unit vectors, one a column
  std::vector<Eigen::Vector2f> directions;  ///< azimuth and height; see lookFeatures()

  std::size_t size() const { return directions.size(); }
};

/// Selects at most `most` features, evenly over the observation. Directions are shares of the image's width and height;
/// the azimuth of a panorama counts in images around the vertical axis, 0 ... cameras, clockwise from camera 0.
LookFeatures lookFeatures(const PlaceObservation& observation, std::size_t most);

/// Returns every `step`-th feature.
LookFeatures thinnedOut(const LookFeatures& look, std::size_t step);

/// Result of comparing two observations descriptor by descriptor.
struct LookAgreement {
  int matches = 0;     ///< descriptors that are each other's nearest, clearly
  int agreeing = 0;    ///< of these, under one displacement (single image) or one change of heading (panorama)
  double whole = 0.0;  ///< agreeing beyond chance, per feature of the smaller set, 0 ... 1
  /// `whole` or the same of the features below the horizon, whichever is less: clouds look the same from everywhere
  /// for minutes.
  double share = 0.0;
};

/// Returns the agreement of two observations. Observations of different numbers of cameras do not agree.
LookAgreement secondLook(const LookFeatures& a, const LookFeatures& b);

/// Returns whether the camera stands still between two observations: most features match at the same pixel.
bool isStationary(const LookFeatures& a, const LookFeatures& b);

}  // namespace fabmap_node
