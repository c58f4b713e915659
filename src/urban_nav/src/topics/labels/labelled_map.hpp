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

/// Digest of the positions of the points of a map, which identifies the map of stored labels. Points are in the order
/// of the map tiles.
class MapPointsDigest {
 public:
  void add(const std::vector<laser_mapper::MapPoint>& points);
  std::int64_t value() const { return static_cast<std::int64_t>(hash_ >> 2U); }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325U;  // FNV-1a
};

/// Stores the labels of a map with its first session.
void storeMapLabels(urban_nav_store::Store& store, const urban_nav_store::SessionId& first,
                    const MapPointsDigest& digest, const std::vector<scene_labeler::PointLabel>& labels);
/// Returns the labels of a map; nullopt if the store has none, or those of another map.
std::optional<std::vector<scene_labeler::PointLabel>> storedMapLabels(urban_nav_store::Store& store,
                                                                      const urban_nav_store::SessionId& first,
                                                                      const laser_mapper::LaserMap& map);

/// Returns the labels of a map as attributes of its points; nullopt if the store has none, or those of another map.
std::optional<PointAttributes> labelAttributes(urban_nav_store::Store& store, const urban_nav_store::SessionId& first,
                                               const laser_mapper::LaserMap& map);

}  // namespace urban_nav
