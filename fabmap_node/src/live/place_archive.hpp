// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "fabmap_node/store/place_sessions.hpp"
#include "urban_nav_store/tables/place_link.hpp"

namespace fabmap_node {

/// Words and descriptors of the places of one session, about 20 kB each, in a file instead of memory.
class PlaceArchive {
 public:
  virtual ~PlaceArchive() = default;
  /// Calls `visit` for all places in order of time. Returns the number of places ignored because their words are of
  /// another model. Throws DataError if one is damaged.
  virtual std::size_t forEach(const PlaceVisitor& visit) const = 0;
  /// Returns packLook() of the place at a stamp; empty if there is no such place. Throws DataError or UserError if it
  /// cannot be read.
  virtual std::string look(urban_nav_core::StampNs stamp) const = 0;
};

/// Session of the live map.
struct ArchivedSession {
  urban_nav_store::Session session;
  std::shared_ptr<const PlaceArchive> places;
};

/// Returns the sessions of a store, which they keep open for reading; some may have no places of the model with this
/// hash. Throws UserError or DataError if it cannot be read.
std::vector<ArchivedSession> archivedSessions(const std::string& path, const std::string& model_hash,
                                              std::size_t vocabulary_size);

/// Returns the links between places of a store, in the order of the sessions and stamps of their later poses; none in a
/// store of an earlier version. Throws UserError or DataError if it cannot be read.
std::vector<urban_nav_store::PlaceLink> storedLinks(const std::string& path);

/// Places of the session being recorded, in an unnamed temporary file. Data that cannot be written, as on a full disk,
/// are kept in memory.
class RecordedPlaces final : public PlaceArchive {
 public:
  RecordedPlaces();
  ~RecordedPlaces() override;
  RecordedPlaces(const RecordedPlaces&) = delete;
  RecordedPlaces& operator=(const RecordedPlaces&) = delete;

  /// Appends a place; stamps must ascend.
  void add(const MapPlace& place);
  std::size_t forEach(const PlaceVisitor& visit) const override;
  std::string look(urban_nav_core::StampNs stamp) const override;

 private:
  struct Entry {
    urban_nav_core::StampNs stamp = 0;
    double travelled = 0.0;
    std::uint64_t offset = 0;  ///< of words and descriptors
    std::uint32_t words = 0, look = 0;
    std::uint8_t cameras = 1, missing = 0;
    bool is_in_memory = false;  ///< `offset` is an index of kept_
  };
  std::string read(const Entry& entry, std::size_t from, std::size_t count) const;

  int file_ = -1;
  std::uint64_t end_ = 0;
  std::vector<Entry> entries_;
  std::vector<std::string> kept_;
};

}  // namespace fabmap_node
