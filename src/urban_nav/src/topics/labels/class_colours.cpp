// SPDX-License-Identifier: BSD-3-Clause
#include "topics/labels/class_colours.hpp"

#include <array>

namespace urban_nav {
namespace {

struct NamedColour {
  ClassColour colour;
  const char* name;
};

// One colour per class, with distinct lightness for colour-blind readers.
constexpr std::array<NamedColour, scene_labeler::kClassCount> kClassColours = {{{{110, 90, 140}, "violet"},
                                                                                {{150, 220, 90}, "light green"},
                                                                                {{190, 190, 190}, "light grey"},
                                                                                {{200, 140, 60}, "brown"},
                                                                                {{220, 70, 50}, "red"},
                                                                                {{250, 190, 170}, "pink"},
                                                                                {{20, 110, 50}, "dark green"},
                                                                                {{40, 100, 230}, "blue"},
                                                                                {{220, 70, 50}, "red"}}};

}  // namespace

ClassColour classColour(scene_labeler::SceneClass label) {
  return label == scene_labeler::SceneClass::None ? ClassColour{60, 60, 60} : kClassColours[toIndex(label)].colour;
}

std::string classColourNames() {
  std::string names;
  for (std::size_t k = 0; k < kClassColours.size(); ++k)
    names += std::string(k == 0 ? "" : ", ") + toString(static_cast<scene_labeler::SceneClass>(k)) + " " +
             kClassColours[k].name;
  return names;
}

}  // namespace urban_nav
