// SPDX-License-Identifier: BSD-3-Clause
#include "topics/labels/label_columns.hpp"

namespace urban_nav {

using scene_labeler::SceneClass;
using urban_nav_core::PlyType;

urban_nav_core::PlyLayout labelLayout() {
  urban_nav_core::PlyLayout layout;
  layout.properties.push_back({"label", PlyType::UChar});
  layout.properties.push_back({"label_probability", PlyType::Float});
  layout.properties.push_back({"unsure", PlyType::UChar});
  std::string classes = "label";
  for (std::size_t k = 0; k < scene_labeler::kClassCount; ++k)
    classes += " " + std::to_string(k) + " " + toString(static_cast<SceneClass>(k)) + ",";
  layout.comments.push_back(classes + " 255 none");
  return layout;
}

std::uint8_t lasClassification(SceneClass label) {
  switch (label) {
    case SceneClass::Paved:
    case SceneClass::Grass:
    case SceneClass::DirtPath: return 2;  // ground: one class, the extra byte distinguishes its kinds
    case SceneClass::TexturedWall:
    case SceneClass::SmoothWall:
    case SceneClass::Wall: return 6;      // building
    case SceneClass::Foliage: return 5;   // high vegetation
    case SceneClass::Vehicle: return 64;  // first user-defined class
    default: return 1;                    // unclassified
  }
}

}  // namespace urban_nav
