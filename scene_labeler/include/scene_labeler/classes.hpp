// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace scene_labeler {

/// Classes of a laser return, with their numbers in files (Newman et al. 2009, section 8; docs/files.md).
enum class SceneClass : std::uint8_t {
  Other = 0,
  Grass,
  Paved,
  DirtPath,
  TexturedWall,
  SmoothWall,
  Foliage,
  Vehicle,
  Wall,        ///< wall of unknown kind
  None = 255,  ///< unlabelled, or no answer
};

constexpr std::size_t kClassCount = 9;  ///< not counting None

constexpr std::size_t toIndex(SceneClass scene_class) { return static_cast<std::size_t>(scene_class); }

/// Returns the name in files: "other", "grass", "paved", ...; "none".
const char* toString(SceneClass scene_class);

/// Returns the class of a name; nullopt for other names. "none" is not a class.
std::optional<SceneClass> classFromName(std::string_view name);

/// Returns the names of all classes, separated by ", ".
std::string classNames();

/// Returns Wall for textured and smooth walls, and other classes unchanged.
SceneClass withOneWall(SceneClass scene_class);

/// Returns whether the class is grass, paving or dirt.
constexpr bool isKindOfGround(SceneClass scene_class) {
  return scene_class == SceneClass::Grass || scene_class == SceneClass::Paved || scene_class == SceneClass::DirtPath;
}

/// Value per class, indexed by toIndex().
using ClassValues = std::array<float, kClassCount>;

}  // namespace scene_labeler
