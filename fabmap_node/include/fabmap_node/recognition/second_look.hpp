// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "fabmap_node/features/place_observation.hpp"

namespace fabmap_node {

inline constexpr int kLookElements = 64;
/// Descriptors for the second look (descriptor matching): adjacent gradient directions are summed, which halves the
/// size.
using LookDescriptors = Eigen::Matrix<float, kLookElements, Eigen::Dynamic>;

/// Feature of a panorama. Its descriptor is reduced to three levels per element, ranks within the descriptor: bit k of
/// `middle` is set if element k is above the lowest third, bit k of `top` if it is in the highest third.
struct PanoramaFeature {
  std::uint64_t middle = 0, top = 0;
  Eigen::Vector2f direction;  ///< azimuth and elevation; see selectFeatures()
};
/// Returns the levels of kLookElements elements, without a direction. Of equal elements, all have the lower level.
PanoramaFeature rankElements(const std::array<unsigned, kLookElements>& elements);

/// Input of descriptor matching: descriptors of an observation with their directions. A single image has fewer features
/// than can be stored, and keeps the resolution of their descriptors; a panorama has more, and keeps their number.
struct ComparedFeatures {
  std::uint8_t cameras = 1;
  LookDescriptors descriptors;              ///< of a single image: unit vectors, one per column
  std::vector<Eigen::Vector2f> directions;  ///< of a single image: one per descriptor; see selectFeatures()
  std::vector<PanoramaFeature> panorama;    ///< of a panorama, by increasing elevation coordinate

  std::size_t size() const { return cameras > 1 ? panorama.size() : directions.size(); }
};

/// Selects features evenly over the observation: at most `most` of a single image; of a panorama, as many as packLook()
/// stores in the same number of bytes. Directions are relative to the image's width and height; the azimuth of a
/// panorama is in images around the vertical axis, 0 ... cameras, clockwise from camera 0.
ComparedFeatures selectFeatures(const PlaceObservation& observation, std::size_t most);

/// Sorts the features of a panorama as ComparedFeatures requires.
void sortByElevation(std::vector<PanoramaFeature>& features);

/// Returns every `step`-th feature.
ComparedFeatures thinnedOut(const ComparedFeatures& look, std::size_t step);

/// Result of matching the descriptors of two observations.
struct LookAgreement {
  int matches = 0;     ///< descriptors that are mutual nearest neighbours by a clear margin
  int agreeing = 0;    ///< those consistent with one displacement (single image) or one change of heading (panorama)
  double whole = 0.0;  ///< consistent matches beyond chance, per feature of the smaller set, 0 ... 1
  /// Panorama: geometric mean of the values of `whole` for features near the horizon and for those away from it. What
  /// is far away appears the same from many places of a street, and what is near repeats along a facade. Single image:
  /// minimum of `whole` and its value for features below the horizon, because clouds appear the same from everywhere
  /// for minutes.
  double share = 0.0;
};

/// Returns the agreement of two observations; zero for different numbers of cameras.
LookAgreement secondLook(const ComparedFeatures& a, const ComparedFeatures& b);

/// Returns whether the camera is stationary between two observations: most features match at the same pixel.
bool isStationary(const ComparedFeatures& a, const ComparedFeatures& b);

}  // namespace fabmap_node
