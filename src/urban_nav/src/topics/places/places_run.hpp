// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/page.hpp"
#include "fabmap_node/decision/travelled_distance.hpp"
#include "fabmap_node/fab_map.hpp"
#include "map/context.hpp"
#include "topics/places/place_writer.hpp"

namespace urban_nav {

/// Place recognition over all sessions of a run.
struct PlacesRun {
  std::vector<std::vector<fabmap_node::PlaceBelief>> beliefs;  ///< over all sessions; empty for previous ones
  std::vector<urban_nav_core::TopologicalClosure> closures;    ///< proposed
  std::size_t observations = 0;                                ///< panoramas, or images without them
  std::size_t places = 0;                                      ///< in the map, those of previous sessions included
  bool has_panoramas = false;
  std::map<std::string, std::size_t> unused;  ///< observations by the reason why they were not used
  std::size_t incomplete = 0;                 ///< panoramas with a camera missing
  std::vector<double> ms_inference;           ///< per observation
  std::vector<std::string> warnings;
};

/// Recognises the places of the sessions of this run, or of all sessions if it joins them, in order, from the rows of
/// the store. Places of other sessions are in the map from the beginning. Each group of sessions (MapContext::groups)
/// has a map of its own. The result does not depend on the number of threads. `known_agreements`: of earlier calls for
/// the same sessions, which it only makes faster; null: none are kept.
PlacesRun runPlaces(const fabmap_node::Parameters& parameters, const LoadedPlaceModel& model, const MapContext& context,
                    fabmap_node::AgreementCache* known_agreements = nullptr);

/// Returns distances along the smoothed odometry of a session, which is in the store, so that places do not depend on
/// whether it was read by this or an earlier run.
fabmap_node::TravelledDistance travelledDistance(const SessionOdometry& run);

/// Returns pairs of thumbnails of recognised places, the query below the place: some with the highest probability, and
/// some with the lowest above the threshold for closures.
std::vector<PagePicture> placePictures(const PlacesRun& run, const MapContext& context);

}  // namespace urban_nav
