// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/store/place_sessions.hpp"

#include "fabmap_node/decision/travelled_distance.hpp"
#include "fabmap_node/model/place_model.hpp"
#include "fabmap_node/store/place_rows.hpp"
#include "urban_nav_store/stored_map.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/stored_model.hpp"

namespace fabmap_node {

using urban_nav_store::Session;
using urban_nav_store::Store;
using urban_nav_store::StoredModel;
using urban_nav_store::StoredPlace;
using urban_nav_store::TableStore;

namespace {

constexpr double assumed_spacing = 1.0;  // m from place to place without a trajectory; panoramas are 0.5 to 2 m apart

TravelledDistance travelledDistance(Store& store, const Session& session) {
  TravelledDistance travelled;
  for (const urban_nav_core::StampedPose& pose : urban_nav_store::readTrajectory(store, session).T_map_base)
    travelled.add(pose.stamp, pose.pose.t());
  return travelled;
}

}  // namespace

StoredPlaces readPlaces(Store& store, const std::string& model_hash, std::size_t vocabulary_size) {
  StoredPlaces stored;
  for (const Session& session : store.sessions().all()) {
    PlaceSession read{session, {}};
    const TravelledDistance travelled = travelledDistance(store, session);
    TableStore<StoredPlace>(store).forEach(session.id, [&](const StoredPlace& row) {
      if (row.model != model_hash) {
        ++stored.other_model;
        return;
      }
      const double distance =
          travelled.empty() ? assumed_spacing * static_cast<double>(read.places.size()) : travelled.at(row.stamp);
      read.places.push_back({row.stamp, toPlaceDescription(row, vocabulary_size), distance});
    });
    if (!read.places.empty()) stored.sessions.push_back(std::move(read));
  }
  return stored;
}

void writePlaces(Store& store, const std::vector<PlaceSession>& sessions, const std::string& model_bytes) {
  const std::string hash = modelHash(model_bytes);
  TableStore<StoredModel> models(store);
  TableStore<StoredPlace> rows(store);
  for (const PlaceSession& each : sessions) {
    store.sessions().put(each.session);
    models.put({each.session.id, hash, "fabmap_node", model_bytes});
    for (const MapPlace& place : each.places)
      rows.put(toStoredPlace(each.session.id, place.stamp, place.description, hash));
  }
}

}  // namespace fabmap_node
