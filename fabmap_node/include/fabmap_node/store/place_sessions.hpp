// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "fabmap_node/recognition/place_describer.hpp"
#include "urban_nav_store/session.hpp"
#include "urban_nav_store/store.hpp"

namespace fabmap_node {

/// Place of a session as a map needs it.
struct MapPlace {
  urban_nav_core::StampNs stamp = 0;
  PlaceDescription description;
  double travelled = 0.0;  ///< m driven in the session until then
};

using PlaceVisitor = std::function<void(const MapPlace&)>;

/// Places of one session of a store, in order of time.
struct PlaceSession {
  urban_nav_store::Session session;
  std::vector<MapPlace> places;
};

/// Places of a store.
struct StoredPlaces {
  std::vector<PlaceSession> sessions;  ///< those that have places, in order of their starts
  std::size_t other_model = 0;         ///< places left out: their words are those of another model
};

/// Calls `visit` for the places of a session whose words are those of the model with this hash, in order of time, with
/// the distance driven along the stored trajectory; without one, places count as one metre apart. Returns the number of
/// places left out. Throws DataError if a row is damaged.
std::size_t forEachPlace(urban_nav_store::Store& store, const urban_nav_store::Session& session,
                         const std::string& model_hash, std::size_t vocabulary_size, const PlaceVisitor& visit);
/// Reads the places of all sessions with forEachPlace().
StoredPlaces readPlaces(urban_nav_store::Store& store, const std::string& model_hash, std::size_t vocabulary_size);

/// Writes a session with the places that `forEach` visits, and the model whose words these are. The store is not
/// committed.
void writePlaces(urban_nav_store::Store& store, const urban_nav_store::Session& session,
                 const std::function<void(const PlaceVisitor&)>& forEach, const std::string& model_bytes);
/// Writes sessions with their places and the model. The store is not committed.
void writePlaces(urban_nav_store::Store& store, const std::vector<PlaceSession>& sessions,
                 const std::string& model_bytes);

}  // namespace fabmap_node
