// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "urban_nav_live/store_writer_link.hpp"
#include "urban_nav_store/tables/place_link.hpp"
#include "urban_nav_store/tables/stored_place.hpp"

namespace fabmap_node {

/// Session store for the places of a driving robot. A background thread commits each second. Data that cannot be
/// written - the file is in use, damaged, or its disk is full - are kept in memory, about 25 kB per place. Used by one
/// thread.
class LivePlaceStore {
 public:
  /// Returns options with room for pending writes in addition to those that are held while the disk is unavailable.
  static urban_nav_live::StoreWriterLink::Options defaultOptions();

  /// `path`: absolute; empty: nothing is stored. `model_bytes`: model of the places' words.
  LivePlaceStore(std::string path, const std::string& model_bytes, urban_nav_live::StoreWriterLink::Options options);
  /// Commits pending data if possible.
  ~LivePlaceStore();
  LivePlaceStore(const LivePlaceStore&) = delete;
  LivePlaceStore& operator=(const LivePlaceStore&) = delete;

  /// Reads the places of a store. Returns the sessions with places.
  using Reader = std::function<std::vector<urban_nav_store::Session>(urban_nav_store::Store&)>;

  /// Opens the file when an attempt is due, and passes pending places to it. A newly opened file is read; errors of
  /// `read` are faults of the file. Call about ten times a second.
  void sync(const Reader& read);
  /// Writes a place, preceded by the session and its model for the first place of a session.
  void put(const urban_nav_store::Session& session, urban_nav_store::StoredPlace place);
  /// Writes a link between places of sessions that the store has or will have; others are ignored.
  void put(urban_nav_store::PlaceLink link);
  /// Marks a session complete, if it has places here.
  void end(const urban_nav_store::Session& session);
  /// Blocks until everything is committed. Throws UserError with the fault of the store if that is impossible.
  void flush();

  bool isWanted() const { return is_wanted_; }
  /// Returns whether the file has, or will have, places of a session.
  bool has(const urban_nav_store::SessionId& session) const { return sessions_.count(session) > 0; }
  /// Returns the state of the file, in which places pending here are included.
  urban_nav_live::StoreState state() const;

 private:
  void handOn();

  const bool is_wanted_;
  const std::string model_bytes_, model_hash_;
  const std::size_t capacity_;
  std::set<urban_nav_store::SessionId> sessions_;  // with places in the file or pending
  std::set<urban_nav_store::SessionId> begun_;     // by this process
  std::deque<urban_nav_store::LiveWriter::Write> waiting_;
  urban_nav_live::StoreWriterLink link_;
};

}  // namespace fabmap_node
