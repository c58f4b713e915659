// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "scene_labeler/classes.hpp"
#include "urban_nav_core/io/cloud/ply_writer.hpp"

namespace urban_nav {

/// Returns the properties and the comment that labels add to the layout of a PLY file: uchar label, float
/// label_probability, uchar unsure.
urban_nav_core::PlyLayout labelLayout();

/// Returns the class of a label in LAS files: those of the ASPRS, and 64 for vehicles.
std::uint8_t lasClassification(scene_labeler::SceneClass label);

}  // namespace urban_nav
