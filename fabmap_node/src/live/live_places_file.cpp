// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>

#include "fabmap_node/recognition/compact_look.hpp"
#include "live/live_places.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_live/session_namer.hpp"
#include "urban_nav_store/merge.hpp"

namespace fabmap_node {

using urban_nav_core::UserError;
using urban_nav_store::Access;
using urban_nav_store::Session;
using urban_nav_store::Store;

namespace {

void requireAbsolute(const std::string& path) {
  if (path.empty() || path.front() != '/') throw UserError("path", "`" + path + "`", "an absolute path");
}

std::size_t countPlaces(const std::vector<PlaceSession>& sessions) {
  std::size_t count = 0;
  for (const PlaceSession& each : sessions) count += each.places.size();
  return count;
}

MapPlace toMapPlace(const DescribedPlace& place, double travelled) {
  MapPlace made{place.stamp, {}, travelled};
  made.description.cameras = checkLook(place.look, "place of the map");
  made.description.words = place.words;
  made.description.look = place.look;
  return made;
}

void addSession(FabMap& map, const std::string& name, const std::vector<MapPlace>& places) {
  map.beginSession(name);
  for (const MapPlace& place : places) map.addPlace(place.stamp, place.description, place.travelled);
}

/// Removes a store at the end of the scope.
struct TemporaryStore {
  std::string path;
  ~TemporaryStore() {
    std::error_code ignored;
    for (const char* suffix : {"", "-wal", "-shm"}) std::filesystem::remove(path + suffix, ignored);
  }
};

}  // namespace

std::vector<PlaceSession> LivePlaces::placeSessions() const {
  std::vector<PlaceSession> sessions;
  for (const Session& session : earlier_) sessions.push_back({session, {}});
  urban_nav_live::SessionNamer namer = namer_;
  const auto name = [&] {
    return namer.begin(name_.recording, odometry_.start().value_or(first_observed_.value_or(0)), resumable_).session;
  };
  sessions.push_back({session_ ? *session_ : name(), {}});
  for (std::size_t i = 0; i < map_->places(); ++i)
    sessions[map_->place(i).session].places.push_back(toMapPlace(map_->place(i), map_->travelled(i)));
  return sessions;
}

void LivePlaces::rebuildMap(const std::vector<PlaceSession>& earlier, const PlaceSession& recorded) {
  auto map = std::make_unique<FabMap>(model_, parameters_);
  earlier_.clear();
  for (const PlaceSession& each : earlier) {
    addSession(*map, each.session.id, each.places);
    earlier_.push_back(each.session);
  }
  addSession(*map, "", recorded.places);
  map_ = std::move(map);
}

std::string LivePlaces::save(const std::string& path) {
  requireAbsolute(path);
  std::vector<PlaceSession> sessions = placeSessions();
  const std::size_t places = countPlaces(sessions);
  if (places == 0) throw UserError("places", "none yet", "panoramas, or images of the left camera");
  std::error_code error;
  const bool exists = std::filesystem::exists(path, error);
  std::vector<std::string> sources;
  if (exists) sources.push_back(path);
  if (store_.isWanted()) {
    syncStore();
    store_.flush();
    const std::string own = store_.state().path;
    if (std::filesystem::equivalent(own, path, error)) return path + ": all places are committed";
    sources.push_back(own);
  }
  sessions.erase(
      std::remove_if(sessions.begin(), sessions.end(),
                     [this](const PlaceSession& each) { return each.places.empty() || store_.has(each.session.id); }),
      sessions.end());
  const TemporaryStore temporary{path + ".saving"};
  if (!sessions.empty()) {
    Store store(temporary.path, Access::Write);
    writePlaces(store, sessions, model_bytes_);
    store.commit();
    sources.push_back(temporary.path);
  }
  urban_nav_store::merge(sources, path);
  return path + ": " + std::to_string(places) + " places are stored";
}

LivePlaces::Added LivePlaces::addSessions(std::vector<PlaceSession> stored) {
  Added added;
  std::vector<PlaceSession> ours = placeSessions();
  const PlaceSession recorded = std::move(ours.back());
  ours.pop_back();
  for (PlaceSession& each : stored) {
    const auto isThis = [&each](const PlaceSession& other) { return other.session.id == each.session.id; };
    if (std::any_of(ours.begin(), ours.end(), isThis) || (session_ && isThis(recorded))) {
      ++added.known;
      continue;
    }
    ++added.sessions;
    added.places += each.places.size();
    ours.push_back(std::move(each));
  }
  rebuildMap(ours, recorded);
  return added;
}

std::string LivePlaces::load(const std::string& path) {
  requireAbsolute(path);
  Store store(path, Access::Read);
  StoredPlaces stored = readPlaces(store, modelHash(model_bytes_), model_.vocabulary.size());
  if (stored.sessions.empty())
    throw UserError(path, stored.other_model > 0 ? "holds places of another model only" : "holds no places",
                    "a store of `urban_nav map` or of ~save, with the same model");
  const Added added = addSessions(std::move(stored.sessions));
  return path + ": " + std::to_string(added.places) + " places of " + std::to_string(added.sessions) +
         " sessions are in the map" +
         (added.known > 0 ? "; " + std::to_string(added.known) + " sessions were there already" : "") +
         (stored.other_model > 0 ? "; " + std::to_string(stored.other_model) + " places of another model left out"
                                 : "");
}

}  // namespace fabmap_node
