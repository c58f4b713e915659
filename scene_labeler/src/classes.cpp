// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/classes.hpp"

#include <vector>

#include "urban_nav_core/io/text.hpp"

namespace scene_labeler {
namespace {

constexpr std::array<const char*, kClassCount> kNamesByIndex = {
    "other", "grass", "paved", "dirt_path", "textured_wall", "smooth_wall", "foliage", "vehicle", "wall"};

}  // namespace

const char* toString(SceneClass scene_class) {
  return scene_class == SceneClass::None ? "none" : kNamesByIndex[toIndex(scene_class)];
}

std::optional<SceneClass> classFromName(std::string_view name) {
  for (std::size_t i = 0; i < kClassCount; ++i)
    if (name == kNamesByIndex[i]) return static_cast<SceneClass>(i);
  return std::nullopt;
}

std::string classNames() {
  return urban_nav_core::joined(std::vector<std::string>(kNamesByIndex.begin(), kNamesByIndex.end()));
}

SceneClass withOneWall(SceneClass scene_class) {
  const bool is_wall = scene_class == SceneClass::TexturedWall || scene_class == SceneClass::SmoothWall;
  return is_wall ? SceneClass::Wall : scene_class;
}

}  // namespace scene_labeler
