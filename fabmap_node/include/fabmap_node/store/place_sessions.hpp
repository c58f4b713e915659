// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "fabmap_node/recognition/place_describer.hpp"
#include "urban_nav_store/session.hpp"
#include "urban_nav_store/store.hpp"

namespace fabmap_node {

/// Place of a session, for a map.
struct MapPlace {
  urban_nav_core::StampNs stamp = 0;
  PlaceDescription description;
  double travelled = 0.0;  ///< m since the beginning of the session
};

using PlaceVisitor = std::function<void(const MapPlace&)>;

/// Places of one session of a store, in order of time.
struct PlaceSession {
  urban_nav_store::Session session;
  std::vector<MapPlace> places;
};

/// Places of a store.
struct StoredPlaces {
  std::vector<PlaceSession> sessions;  ///< sessions with places, in order of their starts
  std::size_t other_model = 0;         ///< places ignored because their words are of another model
};

/// Calls `visit` for the places of a session whose words are of the model with this hash, in order of time, with the
/// distance along the stored trajectory; without a trajectory, places are assumed one metre apart. Returns the number
/// of ignored places. Throws DataError if a row is damaged.
std::size_t forEachPlace(urban_nav_store::Store& store, const urban_nav_store::Session& session,
                         const std::string& model_hash, std::size_t vocabulary_size, const PlaceVisitor& visit);
/// Reads the places of all sessions with forEachPlace().
StoredPlaces readPlaces(urban_nav_store::Store& store, const std::string& model_hash, std::size_t vocabulary_size);

/// Writes a session with the places visited by `forEach`, and the model of their words. Does not commit.
void writePlaces(urban_nav_store::Store& store, const urban_nav_store::Session& session,
                 const std::function<void(const PlaceVisitor&)>& forEach, const std::string& model_bytes);
/// Writes sessions with their places and the model. Does not commit.
void writePlaces(urban_nav_store::Store& store, const std::vector<PlaceSession>& sessions,
                 const std::string& model_bytes);

}  // namespace fabmap_node
