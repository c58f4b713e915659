// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "convert/bag_writer.hpp"
#include "urban_nav_input/session/source.hpp"

namespace urban_nav {

/// Returns the transform from base_link to the colour camera of a folder; empty without one.
std::vector<geometry_msgs::TransformStamped> colourTransforms(const urban_nav_input::SourceInfo& info);

/// Writes the colour images of an item as they are stored, each with its camera_info and its stamp plus `shift`, ns.
void writeColours(const urban_nav_input::SourceItem& item, const urban_nav_input::SourceInfo& info,
                  urban_nav_core::StampNs shift, BagWriter& bag);

}  // namespace urban_nav
