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

enum class Access {
  Read,   ///< changes no byte of the file; a writer may be at work at the same time
  Write,  ///< goes on in the file, or makes it; one writer at a time
};

/// One session store (docs/architecture.md): an SQLite file in WAL mode with any number of sessions.
///
/// What is written gathers in a transaction that the first write opens; commit() makes it last, and what was not
/// committed when the store is closed, or the process ends, has never been there. Once commit() has returned, its content is
/// there after kill -9 and after a power cut: the log is flushed to disk at each commit (synchronous = FULL; NORMAL would keep
/// it after kill -9 but could lose what came after the last checkpoint when the power fails). A commit costs one flush, some
/// milliseconds: call it at known points or once a second, not for each row. Any error while writing takes back all that was not
/// committed.
///
/// Damage is never passed on in silence: every row carries a checksum, every table counts its rows and sums their checksums by
/// session, compared wherever a session's rows are read as a whole; small files are checked throughout when they are opened.
///
/// Errors are UserError or DataError (types/error.hpp) that name the file and what to do: a damaged file, one of a newer
/// version or of another program (left as it is), a full disk, a place that cannot be written, a second writer, a
/// closed store. Not thread-safe: one caller at a time, or LiveWriter.
class Store {
 public:
  Store(const std::string& path, Access access);
  ~Store();
  Store(Store&&) noexcept;
  Store& operator=(Store&&) noexcept;

  const std::string& path() const;

  /// The narrow interfaces that stages see. They live as long as the store; once it is closed each call is a UserError.
  SessionStore& sessions();
  GraphStore& graph();
  ScanStore& scans();
  KeyframeStore& keyframes();
  InputOrder& inputs();
  StageStates& states();

  void commit();
  /// Takes back what was not committed.
  void rollback();
  /// Gives the room that removed rows have left back to the disk. Commits.
  void shrink();
  /// Rolls back what was not committed and closes the file. The destructor does the same.
  void close();

  class Implementation;
  Implementation& implementation() { return *implementation_; }

 private:
  std::unique_ptr<Implementation> implementation_;
};

/// Does a file at `path` begin as a session store of any version does? False for everything else, also where there is nothing.
bool isStore(const std::string& path);

/// Removes a store with the files beside it, so that a new one can be made in its place. UserError where it is in use, or is no
/// store: another program's file is not touched. Nothing happens where there is none. A damaged store is removed.
void removeStore(const std::string& path);

/// Returns the version of the schema that this library writes.
int schemaVersion();

}  // namespace urban_nav_store
