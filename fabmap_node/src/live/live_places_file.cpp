// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>

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

/// Removes a store at the end of the scope.
struct TemporaryStore {
  std::string path;
  ~TemporaryStore() {
    std::error_code ignored;
    for (const char* suffix : {"", "-wal", "-shm"}) std::filesystem::remove(path + suffix, ignored);
  }
};

}  // namespace

Session LivePlaces::recordedSession() const {
  if (session_) return *session_;
  urban_nav_live::SessionNamer namer = namer_;
  if (announced_) return namer.follow(*announced_, resumable_).session;
  return namer.begin(name_.recording, odometry_.start().value_or(first_observed_.value_or(0)), resumable_).session;
}

std::vector<ArchivedSession> LivePlaces::unstoredSessions() const {
  std::vector<ArchivedSession> all = earlier_;
  all.push_back({recordedSession(), recorded_});
  std::vector<std::size_t> places(all.size(), 0);
  for (std::size_t i = 0; i < map_->places(); ++i) ++places[map_->place(i).session];
  std::vector<ArchivedSession> unstored;
  for (std::size_t s = 0; s < all.size(); ++s)
    if (places[s] > 0 && !store_.has(all[s].session.id)) unstored.push_back(all[s]);
  return unstored;
}

std::string LivePlaces::save(const std::string& path) {
  requireAbsolute(path);
  const std::size_t places = map_->places();
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
  const std::vector<ArchivedSession> unstored = unstoredSessions();
  const TemporaryStore temporary{path + ".saving"};
  if (!unstored.empty()) {
    Store store(temporary.path, Access::Write);
    for (const ArchivedSession& each : unstored)
      writePlaces(
          store, each.session, [&each](const PlaceVisitor& visit) { each.places->forEach(visit); }, model_bytes_);
    store.commit();
    sources.push_back(temporary.path);
  }
  urban_nav_store::merge(sources, path);
  return path + ": " + std::to_string(places) + " places are stored";
}

std::string LivePlaces::load(const std::string& path) {
  requireAbsolute(path);
  const Added added = addSessions(path);
  if (added.sessions.empty())
    throw UserError(path, added.other_model > 0 ? "has only places of another model" : "has no places",
                    "a store of `urban_nav map` or of ~save, with the same model");
  return path + ": " + std::to_string(added.places) + " places of " +
         std::to_string(added.sessions.size() - added.known) + " sessions are in the map" +
         (added.known > 0 ? "; " + std::to_string(added.known) + " sessions were in it already" : "") +
         (added.other_model > 0 ? "; " + std::to_string(added.other_model) + " places of another model ignored" : "");
}

}  // namespace fabmap_node
