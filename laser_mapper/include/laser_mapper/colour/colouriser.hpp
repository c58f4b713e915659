// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <list>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "laser_mapper/colour/colour_view.hpp"
#include "laser_mapper/map_point.hpp"
#include "urban_nav_core/sequence/even_thinning.hpp"

namespace laser_mapper {

class ViewProjection;

/// Memory of a Colouriser.
struct ColourMemory {
  std::size_t cached_images = 1;          ///< decoded images kept, at least 1
  std::size_t depth_bytes = 256U << 20U;  ///< depth maps kept, of those of all views; the others are in a file
  std::string folder = {};                ///< of that file, which has no name; empty: that of temporary files
};

/// Colours the points of a map from images (Newman et al. 2009, section 6.1): each point from the best of the views in
/// which it is not occluded by the map, after exposure and white balance of the images have been equalised on common
/// points. Order of calls: addSurface() for all points, equalise() once, then colour(). The result does not depend on
/// the number of threads. Not thread-safe.
class Colouriser {
 public:
  /// `voxel`: distance between points of the map, m. The result does not depend on `memory`. All functions throw
  /// DataError if depth maps cannot be written to a file.
  Colouriser(std::vector<ColourView> views, ImageLoader load, double voxel, ColourMemory memory);
  ~Colouriser();

  /// Adds points, which are near each other, as occluders.
  void addSurface(const std::vector<MapPoint>& points);
  /// Estimates a gain per image and channel.
  void equalise();
  /// Sets red, green and blue of the points that are visible in a view; other points are unchanged. Returns the number
  /// of coloured points.
  std::size_t colour(std::vector<MapPoint>& points);

  /// Returns the factors of blue, green and red for each image.
  const std::vector<std::array<float, 3>>& gains() const { return gains_; }
  std::size_t views() const { return views_.size(); }

 private:
  struct Depths;
  using Colour = std::array<float, 3>;  // blue, green, red
  std::shared_ptr<const urban_nav_registration::Picture> image(std::size_t view);
  std::vector<std::size_t> viewsNear(const std::vector<MapPoint>& points) const;

  const std::vector<ColourView> views_;
  const ImageLoader load_;
  const double voxel_;
  const std::size_t cached_images_;
  std::vector<ViewProjection> projections_;
  std::unique_ptr<Depths> depths_;
  urban_nav_core::EvenThinning<MapPoint> samples_;  ///< points on which images are compared
  std::vector<Colour> gains_;
  std::list<std::size_t> recent_;  ///< views in cache_, most recently used first
  std::unordered_map<
      std::size_t, std::pair<std::shared_ptr<const urban_nav_registration::Picture>, std::list<std::size_t>::iterator>>
      cache_;
};

}  // namespace laser_mapper
