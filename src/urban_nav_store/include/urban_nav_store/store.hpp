// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "urban_nav_store/graph_store.hpp"
#include "urban_nav_store/input_order.hpp"
#include "urban_nav_store/keyframe_store.hpp"
#include "urban_nav_store/scan_store.hpp"
#include "urban_nav_store/session_store.hpp"
#include "urban_nav_store/stage_states.hpp"

namespace urban_nav_store {
/// Access mode of a store.
enum class Access {
  Read,      ///< never changes the file; commits of another program are visible to the next call
  Snapshot,  ///< as Read, but all calls see the file as of its opening: for results from many calls
  Write,     ///< opens the file or creates it; one writer at a time
  Frozen     ///< as Snapshot; also opens releases
};

/// One session store: an SQLite file in WAL mode with any number of sessions.
///
/// Writes are collected in a transaction opened by the first of them. commit() makes it durable, also across kill -9
/// and power loss: the log is flushed to disk at each commit (synchronous = FULL; NORMAL could lose the commits since
/// the last checkpoint in a power failure). A commit costs one flush, some milliseconds: call it at known points or
/// once a second, not per row. Uncommitted writes are discarded by closing the store, by the end of the process, and by
/// any error while writing.
///
/// Damage is always detected: every row has a checksum, and every table stores the number of rows and the sum of their
/// checksums by session, which are compared when the rows of a session are read as a whole; small files are checked
/// completely when they are opened.
///
/// Throws UserError or DataError naming the file and the remedy: a damaged file, one of a newer version or of another
/// program (left unchanged), a full disk, an unwritable path, a second writer, a closed store. Not thread-safe: use
/// LiveWriter from several threads.
class Store {
 public:
  Store(const std::string& path, Access access);
  ~Store();
  Store(Store&&) noexcept;
  Store& operator=(Store&&) noexcept;

  const std::string& path() const;

  /// Interfaces for stages; see also table_store.hpp. They live as long as the store; after close() each call throws
  /// UserError.
  SessionStore& sessions();
  GraphStore& graph();
  ScanStore& scans();
  KeyframeStore& keyframes();
  InputOrder& inputs();
  StageStates& states();

  void commit();
  /// Discards uncommitted writes.
  void rollback();
  /// Commits, releases the space of removed rows to the file system, and copies the log into the file.
  void shrink();
  /// Discards uncommitted writes and closes the file, like the destructor.
  void close();

  class Implementation;
  Implementation& implementation() { return *implementation_; }

 private:
  std::unique_ptr<Implementation> implementation_;
};

/// Returns whether a file exists at `path` and begins like a session store or a release of any version.
bool isStore(const std::string& path);

/// Removes a store, damaged or not, with its auxiliary files. No effect if there is none. Throws UserError if it is in
/// use or is not a store.
void removeStore(const std::string& path);

/// Returns the version of the schema that this library writes.
int schemaVersion();

}  // namespace urban_nav_store
