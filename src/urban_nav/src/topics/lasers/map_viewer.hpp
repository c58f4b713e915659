// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/map_layer.hpp"
#include "laser_mapper/map_point.hpp"
#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/sequence/even_thinning.hpp"

namespace urban_nav {

/// The 3D view of a map in the report: its points, evenly thinned to at most 500 000, and the path, drawn by WebGL with
/// the scripts of `view`. Colours by image, reflectance, height, pass, sensor, sigma or agreement of passes; a click
/// shows the data of a point, the next one its distance from the first. Other stages add colourings (renderMapLayer()).
/// Finer levels of the map are loaded from the folder next to the report, where it exists, as they come into view.
/// Empty without WebGL. The result depends on the order of the points. Not thread-safe.
class MapViewer {
 public:
  /// `number`: makes the element's id unique on the page.
  explicit MapViewer(std::size_t number) : number_(number) {}

  void add(const std::vector<laser_mapper::MapPoint>& points);
  void addPath(const std::vector<urban_nav_core::Vector3d>& path) { paths_.push_back(path); }
  /// Finer levels next to the report, from writeReportTiles(); empty: none.
  void setTiles(std::string list) { tiles_ = std::move(list); }
  /// Returns the self-contained markup with data and script; empty without points.
  std::string render() const;
  /// Returns the number of points that are shown.
  std::size_t points() const { return points_.items().size(); }

 private:
  const std::size_t number_;
  urban_nav_core::EvenThinning<laser_mapper::MapPoint> points_{kMostShownPoints};
  std::vector<std::vector<urban_nav_core::Vector3d>> paths_;
  std::string tiles_;
};

}  // namespace urban_nav
