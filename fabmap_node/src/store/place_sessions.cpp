// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/store/place_sessions.hpp"

#include <algorithm>

#include "fabmap_node/decision/travelled_distance.hpp"
#include "fabmap_node/model/place_model.hpp"
#include "fabmap_node/store/model_rows.hpp"
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

constexpr double kAssumedSpacing = 1.0;  // m between places without a trajectory; panoramas are 0.5 to 2 m apart

TravelledDistance travelledDistance(Store& store, const Session& session) {
  TravelledDistance travelled;
  for (const urban_nav_core::StampedPose& pose : urban_nav_store::readTrajectory(store, session).T_map_base)
    travelled.add(pose.stamp, pose.pose.t());
  return travelled;
}

}  // namespace

std::size_t forEachPlace(Store& store, const Session& session, const std::string& model_hash,
                         std::size_t vocabulary_size, const PlaceVisitor& visit) {
  std::size_t left_out = 0, visited = 0;
  const TravelledDistance travelled = travelledDistance(store, session);
  TableStore<StoredPlace>(store).forEach(session.id, [&](const StoredPlace& row) {
    if (row.model != model_hash) {
      ++left_out;
      return;
    }
    const double distance =
        travelled.empty() ? kAssumedSpacing * static_cast<double>(visited) : travelled.at(row.stamp);
    ++visited;
    visit({row.stamp, toPlaceDescription(row, vocabulary_size), distance});
  });
  return left_out;
}

StoredPlaces readPlaces(Store& store, const std::string& model_hash, std::size_t vocabulary_size) {
  StoredPlaces stored;
  for (const Session& session : store.sessions().all()) {
    PlaceSession read{session, {}};
    stored.other_model += forEachPlace(store, session, model_hash, vocabulary_size,
                                       [&](const MapPlace& place) { read.places.push_back(place); });
    if (!read.places.empty()) stored.sessions.push_back(std::move(read));
  }
  return stored;
}

void writePlaces(Store& store, const Session& session, const std::function<void(const PlaceVisitor&)>& forEach,
                 const std::string& model_bytes) {
  const std::string hash = modelHash(model_bytes);
  store.sessions().put(session);
  TableStore<StoredModel>(store).put(toStoredModel(session.id, hash, model_bytes));
  TableStore<StoredPlace> rows(store);
  forEach([&](const MapPlace& place) { rows.put(toStoredPlace(session.id, place.stamp, place.description, hash)); });
}

void writePlaces(Store& store, const std::vector<PlaceSession>& sessions, const std::string& model_bytes) {
  for (const PlaceSession& each : sessions)
    writePlaces(
        store, each.session,
        [&each](const PlaceVisitor& visit) { std::for_each(each.places.begin(), each.places.end(), visit); },
        model_bytes);
}

}  // namespace fabmap_node
