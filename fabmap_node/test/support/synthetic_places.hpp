// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "fabmap_node/features/place_observation.hpp"

namespace fabmap_node::testing {

/// Descriptors about well separated centres: the synthetic vocabulary of the tests.
inline ByteDescriptor syntheticDescriptor(std::uint32_t kind, std::uint32_t noise) {
  std::mt19937 shape(kind + 1), jitter(noise + 77);
  ByteDescriptor descriptor{};
  double norm = 0.0;
  std::array<double, kDescriptorBytes> value{};
  for (double& x : value) {
    x = static_cast<double>(shape() % 1000);
    x = x > 700.0 ? x + static_cast<double>(jitter() % 100) : 0.0;
    norm += x * x;
  }
  for (std::size_t i = 0; i < kDescriptorBytes; ++i)
    descriptor[i] = static_cast<std::uint8_t>(std::min(255.0, 512.0 * value[i] / std::sqrt(norm)));
  return descriptor;
}

/// Place `number`: about 60 of 300 kinds of features, at positions specific to it. `noise` perturbs descriptors and
/// positions, as on a second visit.
inline PlaceObservation syntheticPlace(std::uint32_t number, std::uint32_t noise, std::uint8_t cameras = 1) {
  std::mt19937 random(1000 + number);
  PlaceObservation observation;
  observation.cameras = cameras;
  for (std::uint32_t k = 0; k < 60; ++k) {
    PlaceFeature feature;
    const std::uint32_t kind = static_cast<std::uint32_t>(random() % 300);
    feature.camera = static_cast<std::uint8_t>(random() % cameras);
    feature.u = static_cast<float>(random() % 1000) / 1000.0F;
    feature.v = static_cast<float>(random() % 1000) / 1000.0F;
    feature.descriptor = syntheticDescriptor(kind, 100 * noise + k);
    feature.u += 0.02F * static_cast<float>(noise);
    observation.features.push_back(feature);
  }
  return observation;
}

}  // namespace fabmap_node::testing
