// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_localization/localiser.hpp"
#include "urban_nav_localization/parameters.hpp"
#include "urban_nav_registration/keyframe/keyframe_conversion.hpp"
#include "urban_nav_registration/retrieval/keyframe_retrieval.hpp"
#include "urban_nav_store/store.hpp"
#include "urban_nav_store/stored_map.hpp"

namespace urban_nav_localization {

/// Keyframe of a map.
struct MapKeyframe {
  urban_nav_store::SessionId session;
  urban_nav_core::StampNs stamp = 0;
  /// Pose of base_link. For a converted keyframe: of the robot with its camera and mounting (KeyframeConversion).
  urban_nav_core::Pose T_map_base;
  /// Conversion to the camera of the drive; null if the cameras are equal.
  std::shared_ptr<const urban_nav_registration::KeyframeConversion> conversion = nullptr;
};

/// The first map of a store, as it is when it is read.
class FrozenMap {
 public:
  /// Throws DataError that names the store if it holds no session, or neither keyframes nor beams of lasers.
  explicit FrozenMap(urban_nav_store::Store& store);

  bool hasKeyframes() const { return !views_.empty(); }
  /// Returns the sessions in order of their starts.
  const std::vector<urban_nav_store::StoredTrajectory>& sessions() const { return sessions_; }
  /// Returns the keyframes of all sessions whose camera is known, to be converted to this one where it is another.
  /// Throws DataError if there are none.
  std::vector<MapKeyframe> findKeyframes(const urban_nav_registration::MountedCamera& camera) const;

 private:
  struct Views {
    std::string camera;  // its words
    std::vector<MapKeyframe> views;
  };
  std::string path_;
  std::vector<urban_nav_store::StoredTrajectory> sessions_;
  std::vector<Views> views_;  // of sessions that have some
};

/// Matches keyframes of a drive with those of a map: with those near the estimated pose or the initial pose, otherwise
/// with the likeliest ones that place recognition finds among all of them. Results are registered by StereoMatcher, so
/// that only a validated transform is a match. Not thread-safe.
class MapSearch {
 public:
  /// `store` must outlive it, unchanged; `retrieval` is not open yet. Throws DataError if the map has no keyframes of
  /// this camera.
  MapSearch(const Parameters& parameters, const FrozenMap& map, urban_nav_store::Store& store,
            const urban_nav_registration::MountedCamera& camera,
            std::shared_ptr<urban_nav_registration::KeyframeRetrieval> retrieval);
  ~MapSearch();
  MapSearch(const MapSearch&) = delete;
  MapSearch& operator=(const MapSearch&) = delete;

  /// Returns the number of keyframes to be read for the search, one in 1.5 m, and of those read so far.
  std::size_t views() const;
  std::size_t read() const;
  /// Reads some more keyframes, for at most some 10 ms. Returns false if none is left.
  bool readNext();

  /// Searches for a keyframe, and adds the match or the miss to the localiser, whose odometry has reached the keyframe.
  /// Returns true for a match.
  bool query(const urban_nav_registration::Keyframe& view, Localiser& localiser);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace urban_nav_localization
