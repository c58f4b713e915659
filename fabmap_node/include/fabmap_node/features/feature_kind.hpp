// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

namespace fabmap_node {

/// What detects and describes features. A model knows the kind it was trained with. Numbers are stored: new ones are
/// appended.
enum class FeatureKind : std::uint8_t {
  Upright = 0,  ///< corners with the upright descriptor of keyframes
  Sift = 1,     ///< OpenCV's SIFT (Lowe 2004), for comparison
  Orb = 2,      ///< OpenCV's ORB (Rublee et al. 2011), for comparison
};

inline constexpr std::array<const char*, 3> feature_kind_names = {"upright", "sift", "orb"};

}  // namespace fabmap_node
