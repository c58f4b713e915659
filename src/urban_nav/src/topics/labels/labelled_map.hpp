// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "laser_mapper/laser_map.hpp"
#include "map/point_attributes.hpp"
#include "scene_labeler/labelling/map_labeler.hpp"
#include "urban_nav_core/io/cloud/ply_writer.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav {

/// Returns the columns of map.ply with labels.
urban_nav_core::PlyLayout labelledMapLayout();
/// Appends the bytes of a label after those of its vertex.
void appendPointLabel(std::string& bytes, const scene_labeler::PointLabel& label);

/// Stores the labels of a map with its first session.
void storeMapLabels(urban_nav_store::Store& store, const urban_nav_store::SessionId& first,
                    const MapPointsDigest& digest, const std::vector<scene_labeler::PointLabel>& labels);
/// Returns the stored labels of a map as attributes of its points; nullopt if the store has none.
std::optional<PointAttributes> labelAttributes(urban_nav_store::Store& store, const urban_nav_store::SessionId& first);

}  // namespace urban_nav
