// SPDX-License-Identifier: BSD-3-Clause
#include "live/live_place_store.hpp"

#include <utility>

#include "fabmap_node/model/place_model.hpp"
#include "fabmap_node/store/model_rows.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/stored_model.hpp"

namespace fabmap_node {

using urban_nav_store::LiveWriter;
using urban_nav_store::Session;
using urban_nav_store::Store;
using urban_nav_store::StoredModel;
using urban_nav_store::StoredPlace;
using urban_nav_store::TableStore;

namespace {
constexpr std::size_t kWaitingPlaces = 1000;  // pending writes of about 25 kB
}

urban_nav_live::StoreWriterLink::Options LivePlaceStore::defaultOptions() {
  urban_nav_live::StoreWriterLink::Options options;
  options.writer.capacity = kWaitingPlaces;
  return options;
}

LivePlaceStore::LivePlaceStore(std::string path, const std::string& model_bytes,
                               urban_nav_live::StoreWriterLink::Options options)
    : is_wanted_(!path.empty()),
      model_bytes_(model_bytes),
      model_hash_(modelHash(model_bytes)),
      capacity_(options.writer.capacity),
      link_(std::move(path), std::move(options)) {}

LivePlaceStore::~LivePlaceStore() { handOn(); }

void LivePlaceStore::sync(const Reader& read) {
  link_.open([&](Store& store) {
    for (const Session& session : read(store)) sessions_.insert(session.id);
  });
  handOn();
}

void LivePlaceStore::handOn() {
  const std::shared_ptr<LiveWriter> writer = link_.writer();
  while (writer && !waiting_.empty() && writer->counts().waiting < capacity_) {
    link_.post(std::move(waiting_.front()));
    waiting_.pop_front();
  }
}

void LivePlaceStore::put(const Session& session, StoredPlace place) {
  if (!is_wanted_) return;
  sessions_.insert(session.id);
  if (begun_.insert(session.id).second)
    waiting_.emplace_back([session, model = toStoredModel(session.id, model_hash_, model_bytes_)](Store& store) {
      store.sessions().put(session);
      TableStore<StoredModel>(store).put(model);
    });
  place.session = session.id;
  place.model = model_hash_;
  waiting_.emplace_back([row = std::move(place)](Store& store) { TableStore<StoredPlace>(store).put(row); });
}

void LivePlaceStore::put(urban_nav_store::PlaceLink link) {
  if (!is_wanted_ || !has(link.session) || !has(link.earlier)) return;
  waiting_.emplace_back(
      [row = std::move(link)](Store& store) { TableStore<urban_nav_store::PlaceLink>(store).put(row); });
}

void LivePlaceStore::end(const Session& session) {
  if (begun_.erase(session.id) == 0) return;
  waiting_.emplace_back([ended = session](Store& store) {
    Session complete = ended;
    complete.complete = true;
    store.sessions().put(complete);
  });
}

void LivePlaceStore::flush() {
  do {
    handOn();
    link_.flush();
  } while (link_.isOpen() && !waiting_.empty() && link_.state().fault.empty());
  const urban_nav_live::StoreState now = state();
  if (!now.fault.empty()) throw urban_nav_core::UserError("", now.fault, "");
  if (now.waiting > 0) throw urban_nav_core::UserError(now.path, "is not open yet", "");
}

urban_nav_live::StoreState LivePlaceStore::state() const {
  urban_nav_live::StoreState state = link_.state();
  state.waiting += waiting_.size();
  return state;
}

}  // namespace fabmap_node
