// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_store/store.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>

#include "file/header.hpp"
#include "schema/schema.hpp"
#include "store_implementation.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_store {

namespace fs = std::filesystem;
using urban_nav_core::UserError;

namespace {

/// Files up to this size are completely checked when opened, which takes about 0.3 s; in larger files damage is
/// detected when the data are read.
constexpr std::uintmax_t kCheckedThroughout = std::uintmax_t{64} << 20;

/// Size of a page of a new store. Each table and each index takes at least one, and most tables of a session hold
/// little: with SQLite's default of 4096 bytes a store takes 160 kB more.
constexpr int kPageBytes = 1024;

/// Size of the log at which its pages are moved to the file.
constexpr std::int64_t kLogBytes = std::int64_t{4} << 20;

std::uintmax_t toSize(const std::string& path) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(path, error);
  return error ? 0 : size;
}

/// Removes auxiliary files left by a missing store, which would be applied to the next one.
void removeBeside(const std::string& path) {
  for (const char* suffix : {"-wal", "-shm", "-journal"}) ::unlink((path + suffix).c_str());
}

/// Creates an empty store atomically.
void make(const std::string& path) {
  removeBeside(path);
  urban_nav_core::PartialFile partial(path, ".part");
  ::unlink(partial.path().c_str());  // left by a process killed here
  removeBeside(partial.path());
  Connection connection(partial.path(), Connection::Mode::Create, path);
  // Both have an effect only before tables exist.
  connection.execute("PRAGMA page_size=" + std::to_string(kPageBytes) + ";PRAGMA auto_vacuum=INCREMENTAL");
  schema::create(connection);
  connection.execute("PRAGMA journal_mode=WAL");
  connection.close();
  removeBeside(partial.path());
  partial.commit();
}

Connection::Mode modeFor(const std::string& path, Access access) {
  if (access == Access::Write) return Connection::Mode::Write;
  // Without a log and a writer the file is complete, and can be read without creating auxiliary files.
  return toSize(path + "-wal") > 0 || WriterLock::isHeld(path) ? Connection::Mode::Read : Connection::Mode::ReadFrozen;
}

void checkThroughout(Connection& connection) {
  Statement statement = connection.prepare("PRAGMA quick_check(1)");
  if (!statement.step()) connection.damaged("it cannot be checked");
  if (const std::string_view answer = statement.text(0); answer != "ok") connection.damaged(std::string(answer));
}

const std::string& prepared(const std::string& path, Access access, std::optional<WriterLock>& lock) {
  if (access == Access::Write) {
    refuseOtherFiles(path);
    lock.emplace(path);
    if (fileKind(path) == FileKind::Absent) make(path);
  } else if (fileKind(path) == FileKind::Absent) {
    throw UserError(path, fs::exists(path) ? "is empty" : "does not exist", "a session store of urban_nav");
  }
  refuseOtherFiles(path, access == Access::Frozen ? Releases::Allowed : Releases::Refused);
  return path;
}

}  // namespace

Store::Implementation::Implementation(const std::string& path, Access access)
    : path_(resolved(path)),
      connection(prepared(path_, access, lock_), modeFor(path_, access)),
      tables(connection),
      sessions(tables, [this] { settle(); }),
      graph(tables),
      scans(tables),
      keyframes(tables),
      inputs(tables),
      states(tables) {
  if (access == Access::Write) {
    Statement statement = connection.prepare("PRAGMA journal_mode=WAL");
    statement.step();
    statement.reset();
    connection.execute("PRAGMA synchronous=FULL");
    connection.execute("PRAGMA wal_autocheckpoint=" +
                       std::to_string(kLogBytes / connection.integer("PRAGMA page_size")));
    schema::migrate(connection, schema::tables());
  }
  if (access == Access::Snapshot || access == Access::Frozen) snapshot_.emplace(connection);
  schema::check(connection);
  if (toSize(path_) <= kCheckedThroughout) checkThroughout(connection);
}

void Store::Implementation::settle() {
  scans.flush();
  inputs.flush();
  scans.forget();
  inputs.forget();
}

void Store::Implementation::commit() {
  scans.flush();
  inputs.flush();
  connection.commit();
}

void Store::Implementation::rollback() {
  scans.forget();
  inputs.forget();
  connection.rollback();
}

void Store::Implementation::shrink() {
  commit();
  Statement statement = connection.prepare("PRAGMA incremental_vacuum");
  while (statement.step()) continue;                                     // one page each
  Statement log = connection.prepare("PRAGMA wal_checkpoint(PASSIVE)");  // so that close() has little left to write
  while (log.step()) continue;
}

void Store::Implementation::close() {
  scans.forget();
  inputs.forget();
  snapshot_.reset();
  connection.close();
  lock_.reset();
}

Store::Store(const std::string& path, Access access)
    : implementation_(std::make_unique<Implementation>(path, access)) {}
Store::~Store() = default;
Store::Store(Store&&) noexcept = default;
Store& Store::operator=(Store&&) noexcept = default;

const std::string& Store::path() const { return implementation_->connection.name(); }
SessionStore& Store::sessions() { return implementation_->sessions; }
GraphStore& Store::graph() { return implementation_->graph; }
KeyframeStore& Store::keyframes() { return implementation_->keyframes; }
ScanStore& Store::scans() { return implementation_->scans; }
InputOrder& Store::inputs() { return implementation_->inputs; }
StageStates& Store::states() { return implementation_->states; }
void Store::commit() { implementation_->commit(); }
void Store::rollback() { implementation_->rollback(); }
void Store::shrink() { implementation_->shrink(); }
void Store::close() { implementation_->close(); }

int schemaVersion() { return schema::latestVersion(schema::tables()); }

bool isStore(const std::string& path) {
  const FileKind kind = fileKind(path);
  return kind == FileKind::Store || kind == FileKind::NewerStore || kind == FileKind::Release;
}

void removeStore(const std::string& given) {
  const std::string path = resolved(given);
  if (fileKind(path) == FileKind::Absent && !fs::exists(path)) return;
  if (fileKind(path) != FileKind::NewerStore) refuseOtherFiles(path);
  const WriterLock lock(path);
  if (::unlink(path.c_str()) != 0)
    throw UserError(path, "cannot be removed", "a file and a folder that can be written");
  removeBeside(path);
}

}  // namespace urban_nav_store
