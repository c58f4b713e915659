// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "fabmap_node/features/place_observation.hpp"

namespace fabmap_node {

inline constexpr int kLookElements = 64;
/// Descriptors for the second look (descriptor matching): adjacent gradient directions are summed, which halves the
/// size.
using LookDescriptors = Eigen::Matrix<float, kLookElements, Eigen::Dynamic>;

/// Input of descriptor matching: descriptors of an observation with their directions.
struct LookFeatures {
  std::uint8_t cameras = 1;
  LookDescriptors descriptors;              ///< unit vectors, one per column
  std::vector<Eigen::Vector2f> directions;  ///< azimuth and elevation; see lookFeatures()

  std::size_t size() const { return directions.size(); }
};

/// Selects at most `most` features, evenly over the observation. Directions are relative to the image's width and
/// height; the azimuth of a panorama is in images around the vertical axis, 0 ... cameras, clockwise from camera 0.
LookFeatures lookFeatures(const PlaceObservation& observation, std::size_t most);

/// Returns every `step`-th feature.
LookFeatures thinnedOut(const LookFeatures& look, std::size_t step);

/// Result of matching the descriptors of two observations.
struct LookAgreement {
  int matches = 0;     ///< descriptors that are mutual nearest neighbours by a clear margin
  int agreeing = 0;    ///< those consistent with one displacement (single image) or one change of heading (panorama)
  double whole = 0.0;  ///< consistent matches beyond chance, per feature of the smaller set, 0 ... 1
  /// Minimum of `whole` and its value for features below the horizon, because clouds appear the same from everywhere
  /// for minutes.
  double share = 0.0;
};

/// Returns the agreement of two observations; zero for different numbers of cameras.
LookAgreement secondLook(const LookFeatures& a, const LookFeatures& b);

/// Returns whether the camera is stationary between two observations: most features match at the same pixel.
bool isStationary(const LookFeatures& a, const LookFeatures& b);

}  // namespace fabmap_node
