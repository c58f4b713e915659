// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "loop_metric/localiser.hpp"
#include "loop_metric/map_search.hpp"
#include "loop_metric/parameters.hpp"
#include "urban_nav_core/types/point_cloud.hpp"
#include "urban_nav_store/store.hpp"

namespace loop_metric {

/// Looks for local clouds of a drive among those of a map, where views do not do: who drives the other way, or through the dark, sees the same walls. Places of the map, some metres
/// apart, are ordered by how well the cloud's outline can be laid upon theirs at any heading; align() judges the best ones, so that only what its classifier
/// accepts becomes a sighting. Not thread-safe. The same calls give the same bits.
class CloudSearch {
 public:
  /// `store` must outlive it, and stay as it is. Without scans in it there are no places.
  CloudSearch(const Parameters& parameters, const FrozenMap& map, urban_nav_store::Store& store);
  ~CloudSearch();
  CloudSearch(const CloudSearch&) = delete;
  CloudSearch& operator=(const CloudSearch&) = delete;

  /// Places of the map, and how many of them have been read: some 100 ms each, of which 10 kB are kept in memory.
  std::size_t places() const;
  std::size_t read() const;
  /// Reads one more; false where none is left.
  bool readNext();

  /// A stretch of the drive to be looked for.
  struct Stretch {
    urban_nav_core::StampNs at = 0;  ///< its middle
    double way = 0.0;                ///< m, on both sides of it
  };
  /// What there is to look for by now: the last metres of the way, as soon as they are enough, then each time the robot has driven on by some metres without being seen by other means.
  std::optional<Stretch> due(const Localiser& localiser) const;

  /// A stretch as the lasers saw it (local_cloud.hpp), and its bend. The sighting goes to the localiser, whose odometry has reached the end of the stretch. True: a sighting.
  bool look(const Stretch& stretch, const urban_nav_core::PointCloud& cloud, double bend, Localiser& localiser);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace loop_metric
