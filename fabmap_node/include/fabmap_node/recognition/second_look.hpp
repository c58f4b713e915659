// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fabmap_node/features/place_observation.hpp"

namespace fabmap_node {

inline constexpr std::size_t kLookElements = 64;
/// Descriptor of a second look before it is reduced to levels: neighbouring directions of the gradient added up.
using LookElements = std::array<std::uint16_t, kLookElements>;

/// Feature of a second look. Elements of its descriptor have three levels, ranks within the descriptor: bit k of
/// `middle` is set if element k is above the lowest third, of `top` if it is in the highest third.
struct LookFeature {
  std::uint64_t middle = 0, top = 0;
  float azimuth = 0.0F;  ///< images around the vertical axis, 0 ... cameras, clockwise from camera 0
  float height = 0.0F;   ///< share of the image's height, 0 ... 1, downwards
};

/// What a second look compares: features of an observation, heights ascending.
struct LookFeatures {
  std::uint8_t cameras = 1;
  std::vector<LookFeature> features;

  std::size_t size() const { return features.size(); }
};

/// Returns a feature with the levels of `elements`. Scale and offset of the elements do not matter. Of equal elements
/// at a limit, the lower level counts.
LookFeature lookFeature(const LookElements& elements, float azimuth, float height);

/// Sorts features as LookFeatures has them: heights ascending, then azimuths.
void sortByHeight(std::vector<LookFeature>& features);

/// Selects at most `most` features, evenly over the observation.
LookFeatures lookFeatures(const PlaceObservation& observation, std::size_t most);

/// Result of comparing two observations descriptor by descriptor.
struct LookAgreement {
  int matches = 0;     ///< descriptors that are each other's nearest, clearly
  int agreeing = 0;    ///< of these, under one displacement (single image) or one change of heading (panorama)
  double share = 0.0;  ///< agreeing beyond chance, per feature of the smaller set, 0 ... 1
};

/// Returns the agreement of two observations, which does not depend on their order. Observations of different numbers
/// of cameras do not agree. Requires heights in ascending order.
LookAgreement secondLook(const LookFeatures& a, const LookFeatures& b);

/// Returns whether the camera stands still between two observations: most features match at the same pixel. Requires
/// heights in ascending order.
bool isStationary(const LookFeatures& a, const LookFeatures& b);

}  // namespace fabmap_node
