// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "urban_nav_live/stage_report.hpp"
#include "urban_nav_store/live_writer.hpp"

namespace urban_nav_live {

/// State of the store written by a stage.
struct StoreState {
  std::string path;   ///< empty: there is no store, or its temporary file does not exist yet
  std::string fault;  ///< why writes do not reach it; empty: no fault
  std::int64_t committed = 0, refused = 0;
  std::int64_t lost = 0;  ///< writes dropped because the queue was full or there was no store
  std::size_t waiting = 0;
};

/// Appends the state of a store to a report.
void addStoreFigures(const StoreState& state, StageReport& report);

/// Session store written by a running stage. Opens the file when possible; a fault is reported and the next attempt
/// follows after a pause. Writes never block on the disk. Thread-safe.
class StoreWriterLink {
 public:
  using Clock = std::chrono::steady_clock;
  enum class EmptyPath {
    NoStore,       ///< nothing is stored, which is not a fault
    TemporaryFile  ///< a file that is removed by the destructor
  };
  struct Options {
    EmptyPath empty_path = EmptyPath::NoStore;
    std::chrono::milliseconds retry_period{10'000};
    urban_nav_store::LiveWriter::Options writer;
    std::function<Clock::time_point()> now = &Clock::now;
  };
  /// Reads a newly opened store before the first write. An error is a fault of the store.
  using Reader = std::function<void(urban_nav_store::Store&)>;

  /// `path`: absolute.
  explicit StoreWriterLink(std::string path, Options options);
  explicit StoreWriterLink(std::string path) : StoreWriterLink(std::move(path), Options()) {}
  /// Commits pending writes as far as possible.
  ~StoreWriterLink();
  StoreWriterLink(const StoreWriterLink&) = delete;
  StoreWriterLink& operator=(const StoreWriterLink&) = delete;

  /// Tries to open the file if it is not open and an attempt is due. Returns true once, when it has been opened. Call
  /// about ten times a second. Blocks while a newly opened store is read.
  bool open(const Reader& read = {});
  bool isOpen() const { return writer() != nullptr; }
  /// Queues a write. Drops and counts it if the queue is full or there is no store.
  void post(urban_nav_store::LiveWriter::Write write);
  /// Blocks until all earlier writes are committed or have failed.
  void flush();

  /// Returns null until the file is open. The last owner closes the store.
  std::shared_ptr<urban_nav_store::LiveWriter> writer() const;
  std::string path() const;
  StoreState state() const;

 private:
  const Options options_;
  mutable std::mutex mutex_;  // guards all members below
  std::string path_, folder_, fault_;
  std::shared_ptr<urban_nav_store::LiveWriter> writer_;
  std::optional<Clock::time_point> tried_;
  std::int64_t lost_ = 0;
};

}  // namespace urban_nav_live
