// SPDX-License-Identifier: BSD-3-Clause
#include "sqlite/connection.hpp"

#include <sqlite3.h>

#include <cstdio>

#include "sqlite/errors.hpp"

namespace urban_nav_store {

namespace {

constexpr int kPatience = 5000;  // ms to wait for another process that recovers the log or closes its connection

/// Returns a path in the syntax of SQLite's URIs.
std::string toUri(const std::string& path) {
  std::string uri = "file:";
  for (const char c : path) {
    if (c == '%' || c == '?' || c == '#') {
      char code[4];
      std::snprintf(code, sizeof code, "%%%02X", static_cast<unsigned char>(c));
      uri += code;
    } else {
      uri += c;
    }
  }
  return uri;
}

/// Returns errno of the last failed system call on the file or its log.
int findSystemError(sqlite3* handle) {
  if (const int error = sqlite3_system_errno(handle); error != 0) return error;
  int error = 0;
  sqlite3_file* log = nullptr;
  sqlite3_file_control(handle, "main", SQLITE_FCNTL_JOURNAL_POINTER, &log);
  if (log != nullptr && log->pMethods != nullptr) log->pMethods->xFileControl(log, SQLITE_FCNTL_LAST_ERRNO, &error);
  if (error == 0) sqlite3_file_control(handle, "main", SQLITE_FCNTL_LAST_ERRNO, &error);
  return error;
}

int toFlags(Connection::Mode mode) {
  constexpr int kCommon = SQLITE_OPEN_URI | SQLITE_OPEN_NOMUTEX;
  switch (mode) {
    case Connection::Mode::Read:
    case Connection::Mode::ReadFrozen: return kCommon | SQLITE_OPEN_READONLY;
    case Connection::Mode::Write: return kCommon | SQLITE_OPEN_READWRITE;
    case Connection::Mode::Create: break;
  }
  return kCommon | SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
}

}  // namespace

Connection::Connection(const std::string& path, Mode mode, std::string name)
    : name_(name.empty() ? path : std::move(name)), writes_(mode == Mode::Write || mode == Mode::Create) {
  // A relative path that begins with a slash, or with "//", would be parsed as a host of the URI.
  const std::string uri =
      toUri(path.rfind("//", 0) == 0 ? path.substr(1) : path) + (mode == Mode::ReadFrozen ? "?immutable=1" : "");
  const int code = sqlite3_open_v2(uri.c_str(), &handle_, toFlags(mode), nullptr);
  try {
    if (code != SQLITE_OK) fail(code);
    sqlite3_extended_result_codes(handle_, 1);
    sqlite3_busy_timeout(handle_, kPatience);
    sqlite3_db_config(handle_, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
    // A damaged page must raise an error when it is read, and a damaged schema must not call functions.
    execute("PRAGMA cell_size_check=ON; PRAGMA trusted_schema=OFF; PRAGMA temp_store=MEMORY; PRAGMA mmap_size=0");
  } catch (...) {
    sqlite3_close_v2(handle_);
    throw;
  }
}

Connection::~Connection() { close(); }

void Connection::close() {
  cached_.clear();
  if (handle_ != nullptr) sqlite3_close_v2(handle_);
  handle_ = nullptr;
}

sqlite3* Connection::handle() const {
  if (handle_ == nullptr) throwClosed(name_);
  return handle_;
}

void Connection::fail(int code) const {
  const int system_error = handle_ == nullptr ? 0 : findSystemError(handle_);
  const bool of_the_disk = (code & 0xff) == SQLITE_IOERR || (code & 0xff) == SQLITE_CANTOPEN ||
                           (code & 0xff) == SQLITE_READONLY || (code & 0xff) == SQLITE_FULL;
  const std::string message = handle_ == nullptr ? sqlite3_errstr(code) : sqlite3_errmsg(handle_);
  if (handle_ != nullptr && sqlite3_get_autocommit(handle_) == 0)
    sqlite3_exec(handle_, "ROLLBACK", nullptr, nullptr, nullptr);
  throwError(name_, code, of_the_disk ? system_error : 0, message);
}

void Connection::damaged(const std::string& what) const {
  if (handle_ != nullptr && sqlite3_get_autocommit(handle_) == 0)
    sqlite3_exec(handle_, "ROLLBACK", nullptr, nullptr, nullptr);
  throwDamaged(name_, what);
}

void Connection::execute(const std::string& sql) {
  const int code = sqlite3_exec(handle(), sql.c_str(), nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) fail(code);
}

Statement Connection::prepare(const std::string& sql) { return Statement(*this, sql); }

Statement& Connection::cached(const std::string& sql) {
  handle();
  const auto found = cached_.find(sql);
  return found != cached_.end() ? found->second : cached_.emplace(sql, prepare(sql)).first->second;
}

std::int64_t Connection::integer(const std::string& sql) {
  Statement statement = prepare(sql);
  if (!statement.step()) damaged("no answer to " + sql);
  return statement.integer(0);
}

bool Connection::inTransaction() const { return sqlite3_get_autocommit(handle()) == 0; }

void Connection::beginWriting() {
  handle();
  if (!writes_) throwReadOnly(name_);
  if (!inTransaction()) execute("BEGIN IMMEDIATE");
}

void Connection::commit() {
  if (inTransaction()) execute("COMMIT");
}

void Connection::rollback() {
  if (inTransaction()) execute("ROLLBACK");
}

void Connection::endReading() noexcept {
  if (handle_ != nullptr && sqlite3_get_autocommit(handle_) == 0)
    sqlite3_exec(handle_, "COMMIT", nullptr, nullptr, nullptr);
}

}  // namespace urban_nav_store
