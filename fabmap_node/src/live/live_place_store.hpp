// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "urban_nav_live/store_writer_link.hpp"
#include "urban_nav_store/tables/stored_place.hpp"

namespace fabmap_node {

/// Session store that receives the places of a robot while it drives. A thread of its own commits each second. What
/// the file does not take - it is in use, damaged, or its disk is full - waits in memory, some 25 kB a place. Used by
/// one thread.
class LivePlaceStore {
 public:
  /// `path`: absolute; empty: nothing is stored. `model_bytes`: the model whose words the places have.
  LivePlaceStore(std::string path, const std::string& model_bytes, urban_nav_live::StoreWriterLink::Options options);
  /// Commits what can be committed.
  ~LivePlaceStore();
  LivePlaceStore(const LivePlaceStore&) = delete;
  LivePlaceStore& operator=(const LivePlaceStore&) = delete;

  /// Reads the places of a store. Returns the sessions that have some.
  using Reader = std::function<std::vector<urban_nav_store::Session>(urban_nav_store::Store&)>;

  /// Opens the file when an attempt is due, and hands on what waits. A file that has just been opened is read; what
  /// `read` throws is a fault of the file. To be called some ten times a second.
  void sync(const Reader& read);
  /// Writes a place, and before the first one of a session the session and its model.
  void put(const urban_nav_store::Session& session, urban_nav_store::StoredPlace place);
  /// Marks a session complete, if it has places here.
  void end(const urban_nav_store::Session& session);
  /// Blocks until all is committed. Throws UserError with the fault of the store if that is impossible.
  void flush();

  bool isWanted() const { return is_wanted_; }
  /// Returns whether the file has, or will have, places of a session.
  bool has(const urban_nav_store::SessionId& session) const { return sessions_.count(session) > 0; }
  /// Returns the state of the file; what waits here counts as waiting.
  urban_nav_live::StoreState state() const;

 private:
  void handOn();

  const bool is_wanted_;
  const std::string model_bytes_, model_hash_;
  const std::size_t capacity_;
  std::set<urban_nav_store::SessionId> sessions_;  // with places in the file, or on their way
  std::set<urban_nav_store::SessionId> begun_;     // by this process
  std::deque<urban_nav_store::LiveWriter::Write> waiting_;
  urban_nav_live::StoreWriterLink link_;
};

}  // namespace fabmap_node
