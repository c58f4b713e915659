// SPDX-License-Identifier: BSD-3-Clause
#include <set>

#include "fabmap_node/recognition/compact_look.hpp"
#include "live/live_places.hpp"
#include "urban_nav_core/types/error.hpp"

namespace fabmap_node {

using urban_nav_store::PlaceLink;

std::string LivePlaces::readLook(std::size_t session, urban_nav_core::StampNs stamp) {
  const PlaceArchive& archive = session < earlier_.size() ? *earlier_[session].places : *recorded_;
  try {
    std::string look = archive.look(stamp);
    if (!look.empty()) return look;
    unreadable_ = "the store no longer has the place at " + urban_nav_core::printStamp(stamp) + " s";
  } catch (const urban_nav_core::Error& error) {
    unreadable_ = error.what();
  }
  return packLook({});
}

std::unique_ptr<FabMap> LivePlaces::emptyMap() {
  return std::make_unique<FabMap>(model_, parameters_, [this](std::size_t session, urban_nav_core::StampNs stamp) {
    return readLook(session, stamp);
  });
}

LivePlaces::BuiltMap LivePlaces::buildMap(const std::vector<ArchivedSession>& earlier,
                                          const std::set<urban_nav_core::PoseRef>& without) {
  BuiltMap built{emptyMap(), {}, 0};
  const auto add = [&built](const MapPlace& place) {
    built.map->addPlace(place.stamp, place.description, place.travelled);
  };
  for (const ArchivedSession& each : earlier) {
    bool has_places = false;
    built.other_model += each.places->forEach([&](const MapPlace& place) {
      if (!has_places) built.map->beginSession(each.session.id);
      has_places = true;
      if (without.count({each.session.id, place.stamp}) == 0) add(place);
    });
    if (has_places) built.earlier.push_back(each);
  }
  built.map->beginSession("");
  recorded_->forEach(add);
  return built;
}

void LivePlaces::useMap(BuiltMap built) {
  map_ = std::move(built.map);
  earlier_ = std::move(built.earlier);
  for (const PlaceLink& link : links_) apply(link);
}

LivePlaces::Added LivePlaces::addSessions(const std::string& path) {
  Added added;
  std::set<urban_nav_store::SessionId> known;
  for (const ArchivedSession& each : earlier_) known.insert(each.session.id);
  if (session_) known.insert(session_->id);
  std::vector<ArchivedSession> all = earlier_;
  for (ArchivedSession& each : archivedSessions(path, modelHash(model_bytes_), model_.vocabulary.size())) {
    if (known.count(each.session.id) == 0) {
      all.push_back(std::move(each));
    } else {
      ++added.known;
      added.sessions.push_back(each.session);
    }
  }
  if (all.size() == earlier_.size()) return added;
  BuiltMap built = buildMap(all);
  added.other_model = built.other_model;
  added.places = built.map->places() - map_->places();
  if (added.places == 0) return added;
  for (const ArchivedSession& each : built.earlier)
    if (known.count(each.session.id) == 0) added.sessions.push_back(each.session);
  for (PlaceLink& link : storedLinks(path))
    if (known.count(link.session) == 0) links_.push_back(std::move(link));
  useMap(std::move(built));
  if (map_->forgotten() > 0) compact();
  return added;
}

}  // namespace fabmap_node
