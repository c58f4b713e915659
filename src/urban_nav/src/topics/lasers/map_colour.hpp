// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "laser_mapper/calibration/view_calibration.hpp"
#include "laser_mapper/colour/colouriser.hpp"
#include "laser_mapper/laser_map.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav {

constexpr double kViewDistance = 0.7, kViewAngle = 0.26;  ///< m, rad: between views of one camera

/// Colours of the points of a map from stored images of its sessions (panoramas, other cameras with colour), about 0.7
/// m or 15 deg apart. They are computed once and kept in the store, until chunks, poses or images differ. Not
/// thread-safe.
class MapColours {
 public:
  /// Reads or prepares the colours of a rendered map, which requires two passes over its tiles if they are not stored.
  /// Store and map must outlive this object. `memory_mb`: for decoded images. `keep`: writes computed colours to the
  /// store, which must be open for writing.
  MapColours(urban_nav_store::Store& store, const laser_mapper::LaserMap& map,
             const std::vector<laser_mapper::MappedSession>& sessions, double memory_mb, bool keep);
  ~MapColours();

  /// Returns the number of images; 0: no image is within the time of the trajectories.
  std::size_t views() const { return views_; }
  /// Returns whether colours are computed from images, which takes longer than all else of an export.
  bool areComputed() const { return colouriser_ != nullptr; }
  /// Sets red, green and blue of the points of a tile that are visible in an image. Returns their number.
  std::size_t colour(const laser_mapper::Tile& tile, std::vector<laser_mapper::MapPoint>& points);
  /// Commits the kept colours. To be called after the last tile.
  void finish();

 private:
  bool isStored() const;
  void removeStored();

  urban_nav_store::Store& store_;
  const std::vector<laser_mapper::MappedSession> sessions_;
  const bool keep_;
  std::size_t views_ = 0;
  std::string digest_;
  std::unique_ptr<laser_mapper::Colouriser> colouriser_;  // null: the colours are stored, or there are no images
};

/// Returns the colouriser of stored images of sessions; null without any. `memory_mb`: of images and depth maps.
std::unique_ptr<laser_mapper::Colouriser> makeColouriser(urban_nav_store::Store& store,
                                                         const std::vector<laser_mapper::MappedSession>& sessions,
                                                         double voxel, double memory_mb);

/// Calibrates the panoramic head of a session by the colours of its map; nullopt if there are no panoramas within the
/// time of the trajectory. `odometry`: see laser_mapper::ViewCalibrator.
std::optional<laser_mapper::ViewCalibration> calibratePanoramas(urban_nav_store::Store& store,
                                                                const laser_mapper::MappedSession& session,
                                                                const urban_nav_core::OdometryChain& odometry,
                                                                const laser_mapper::LaserMap& map);

}  // namespace urban_nav
