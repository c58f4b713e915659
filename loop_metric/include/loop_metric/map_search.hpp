// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "loop_metric/keyframe.hpp"
#include "loop_metric/localiser.hpp"
#include "loop_metric/parameters.hpp"
#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_store/keyframe_store.hpp"
#include "urban_nav_store/stored_map.hpp"

namespace loop_metric {

/// A view of a map.
struct MapView {
  urban_nav_store::SessionId session;
  urban_nav_core::StampNs stamp = 0;
  urban_nav_core::Pose T_map_base;
};

/// What one localises in: the first map of a store, as it is in the moment that it is read.
class FrozenMap {
 public:
  /// Throws DataError that names the store where it holds no session, or no view to recognise.
  explicit FrozenMap(urban_nav_store::Store& store);

  /// Its sessions in order of their starts.
  const std::vector<urban_nav_store::StoredTrajectory>& sessions() const { return sessions_; }
  /// The views of sessions whose camera has these words (camera_words.hpp). Throws DataError where there is none.
  std::vector<MapView> viewsOf(const std::string& camera_words) const;

 private:
  struct Views {
    std::string camera;  // its words
    std::vector<MapView> views;
  };
  std::string path_;
  std::vector<urban_nav_store::StoredTrajectory> sessions_;
  std::vector<Views> views_;  // of sessions that have some
};

/// Looks for views of a drive among those of a map: those near to where the robot is known, or believed, to be, and where they show nothing of it, and it is
/// not known, all of them. What is found is registered by StereoMatcher, so that only what fits by the patch becomes a sighting. Not thread-safe.
class MapSearch {
 public:
  /// `store` must outlive it, and stay as it is. Throws DataError where the map has no view of this camera.
  MapSearch(const Parameters& parameters, const FrozenMap& map, const urban_nav_store::KeyframeStore& store,
            const urban_nav_core::StereoCamera& camera, const urban_nav_core::Pose& T_base_left);
  ~MapSearch();
  MapSearch(const MapSearch&) = delete;
  MapSearch& operator=(const MapSearch&) = delete;

  /// Views of the map, and how many of them have been read for the search: some 10 ms each that is kept in memory, one in a metre and a half.
  std::size_t views() const;
  std::size_t read() const;
  /// Reads one more; false where none is left.
  bool readNext();

  /// The sighting, or that there is none, goes to the localiser, whose odometry has reached the view. True: a sighting.
  bool look(const Keyframe& view, Localiser& localiser);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace loop_metric
