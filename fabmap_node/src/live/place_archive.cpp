// SPDX-License-Identifier: BSD-3-Clause
#include "live/place_archive.hpp"

#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/stored_place.hpp"

namespace fabmap_node {

using urban_nav_core::StampNs;
using urban_nav_store::Access;
using urban_nav_store::Session;
using urban_nav_store::Store;
using urban_nav_store::StoredPlace;
using urban_nav_store::TableStore;

namespace {

/// Session of a store that is shared with other sessions.
class StoredSession final : public PlaceArchive {
 public:
  StoredSession(std::shared_ptr<Store> store, Session session, std::string model_hash, std::size_t vocabulary_size)
      : store_(std::move(store)),
        session_(std::move(session)),
        model_hash_(std::move(model_hash)),
        vocabulary_size_(vocabulary_size) {}

  std::size_t forEach(const PlaceVisitor& visit) const override {
    return forEachPlace(*store_, session_, model_hash_, vocabulary_size_, visit);
  }

  std::string look(StampNs stamp) const override {
    StoredPlace key;
    key.session = session_.id;
    key.stamp = stamp;
    const std::optional<StoredPlace> row = TableStore<StoredPlace>(*store_).get(key);
    return row ? row->descriptors : std::string();
  }

 private:
  const std::shared_ptr<Store> store_;
  const Session session_;
  const std::string model_hash_;
  const std::size_t vocabulary_size_;
};

/// Returns a file that is deleted when it is closed, or -1.
int openTemporaryFile() {
  std::error_code error;
  std::string path = (std::filesystem::temp_directory_path(error) / "urban_nav_places_XXXXXX").string();
  const int file = error ? -1 : ::mkstemp(path.data());
  if (file >= 0) ::unlink(path.c_str());
  return file;
}

bool writeAt(int file, const std::string& bytes, std::uint64_t offset) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t count = ::pwrite(file, bytes.data() + done, bytes.size() - done, static_cast<off_t>(offset + done));
    if (count <= 0) return false;
    done += static_cast<std::size_t>(count);
  }
  return true;
}

std::string readAt(int file, std::uint64_t offset, std::size_t size) {
  std::string bytes(size, '\0');
  for (std::size_t done = 0; done < size;) {
    const ssize_t count = ::pread(file, bytes.data() + done, size - done, static_cast<off_t>(offset + done));
    if (count <= 0) throw urban_nav_core::DataError("temporary file of places", "cannot be read", "");
    done += static_cast<std::size_t>(count);
  }
  return bytes;
}

}  // namespace

std::vector<ArchivedSession> archivedSessions(const std::string& path, const std::string& model_hash,
                                              std::size_t vocabulary_size) {
  const auto store = std::make_shared<Store>(path, Access::Read);
  std::vector<ArchivedSession> sessions;
  for (const Session& session : store->sessions().all())
    sessions.push_back({session, std::make_shared<StoredSession>(store, session, model_hash, vocabulary_size)});
  return sessions;
}

std::vector<urban_nav_store::PlaceLink> storedLinks(const std::string& path) {
  Store store(path, Access::Read);
  std::vector<urban_nav_store::PlaceLink> links;
  for (const Session& session : store.sessions().all())
    TableStore<urban_nav_store::PlaceLink>(store).forEach(
        session.id, [&](const urban_nav_store::PlaceLink& link) { links.push_back(link); });
  return links;
}

RecordedPlaces::RecordedPlaces() : file_(openTemporaryFile()) {}

RecordedPlaces::~RecordedPlaces() {
  if (file_ >= 0) ::close(file_);
}

void RecordedPlaces::add(const MapPlace& place) {
  const std::size_t words = place.description.words.size() * sizeof(Word);
  std::string bytes(words, '\0');
  std::memcpy(bytes.data(), place.description.words.data(), words);
  bytes += place.description.look;
  Entry entry{place.stamp, place.travelled, end_, static_cast<std::uint32_t>(words)};
  entry.look = static_cast<std::uint32_t>(place.description.look.size());
  entry.cameras = place.description.cameras;
  entry.missing = place.description.missing;
  if (file_ >= 0 && writeAt(file_, bytes, end_)) {
    end_ += bytes.size();
  } else {
    entry.is_in_memory = true;
    entry.offset = kept_.size();
    kept_.push_back(std::move(bytes));
  }
  entries_.push_back(entry);
}

std::string RecordedPlaces::read(const Entry& entry, std::size_t from, std::size_t count) const {
  if (entry.is_in_memory) return kept_[entry.offset].substr(from, count);
  return readAt(file_, entry.offset + from, count);
}

std::size_t RecordedPlaces::forEach(const PlaceVisitor& visit) const {
  for (const Entry& entry : entries_) {
    const std::string bytes = read(entry, 0, entry.words + entry.look);
    MapPlace place;
    place.stamp = entry.stamp;
    place.travelled = entry.travelled;
    place.description.cameras = entry.cameras;
    place.description.missing = entry.missing;
    place.description.words.resize(entry.words / sizeof(Word));
    std::memcpy(place.description.words.data(), bytes.data(), entry.words);
    place.description.look = bytes.substr(entry.words);
    visit(place);
  }
  return 0;
}

std::string RecordedPlaces::look(StampNs stamp) const {
  const auto found = std::lower_bound(entries_.begin(), entries_.end(), stamp,
                                      [](const Entry& entry, StampNs wanted) { return entry.stamp < wanted; });
  if (found == entries_.end() || found->stamp != stamp) return {};
  return read(*found, found->words, found->look);
}

}  // namespace fabmap_node
