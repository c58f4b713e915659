// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "urban_nav_core/types/point_cloud.hpp"
#include "urban_nav_localization/localiser.hpp"
#include "urban_nav_localization/map_search.hpp"
#include "urban_nav_localization/parameters.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav_localization {

/// Sensors of a drive whose beams make its local clouds.
enum class BeamSources {
  PlanarLasers,  ///< a cloud extends as far as the robot has driven
  Lidars,        ///< 3D LiDARs: each sweep shows the surroundings
};

/// Matches local clouds of a drive with those of a map: without cameras, or where image matching fails, as in the
/// opposite direction of travel or in darkness. Places of the map, some metres apart, are ranked by how well the
/// vertical structure of the cloud fits theirs at any heading; the best ones are aligned, and only validated alignments
/// are matches. Not thread-safe. Deterministic.
class CloudSearch {
 public:
  /// `store` must outlive it, unchanged. A store without scans and sweeps has no places.
  CloudSearch(const Parameters& parameters, const FrozenMap& map, urban_nav_store::Store& store);
  ~CloudSearch();
  CloudSearch(const CloudSearch&) = delete;
  CloudSearch& operator=(const CloudSearch&) = delete;

  /// Returns the number of places of the map, and of those read so far. Reading takes some 100 ms each, of which 10 kB
  /// stay in memory.
  std::size_t places() const;
  std::size_t read() const;
  /// Reads one more place. Returns false if none is left.
  bool readNext();

  /// Stretch of the drive to be searched for.
  struct Stretch {
    urban_nav_core::StampNs at = 0;  ///< its middle
    double way = 0.0;                ///< m, on both sides of it
    bool is_firm = true;             ///< its match may start a hypothesis
  };
  /// Returns the stretch that is due: the last metres of the drive, as soon as they suffice, then again each time the
  /// robot has driven on by some metres without a match.
  std::optional<Stretch> due(const Localiser& localiser, BeamSources sources) const;

  /// Searches for a stretch by its local cloud (local_cloud.hpp) and the deformation of that. A match is added to the
  /// localiser, whose odometry has reached the end of the stretch. Returns true for a match.
  bool query(const Stretch& stretch, const urban_nav_core::PointCloud& cloud, double deformation_sigma,
             Localiser& localiser);
  /// Adds a query without a match to the localiser, for a drive without keyframes, whose misses are counted otherwise.
  void addMiss(const Stretch& stretch, Localiser& localiser) const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace urban_nav_localization
