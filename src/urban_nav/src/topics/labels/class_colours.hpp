// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "scene_labeler/classes.hpp"

namespace urban_nav {

struct ClassColour {
  std::uint8_t red = 0, green = 0, blue = 0;
};

/// Returns the colour of a class in pictures; grey without a class.
ClassColour classColour(scene_labeler::SceneClass label);

/// Returns the legend: "grass green, paved grey, ...".
std::string classColourNames();

}  // namespace urban_nav
