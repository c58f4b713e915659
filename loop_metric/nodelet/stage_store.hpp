// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "urban_nav_store/live_writer.hpp"

namespace loop_metric {

/// How it stands with the store.
struct StoreState {
  std::string path;   ///< empty before the first attempt to make a temporary one
  std::string fault;  ///< why what comes does not reach it; empty: it does
  std::int64_t committed = 0, refused = 0;
  std::int64_t lost = 0;  ///< writes for which there was no room, or no store
  std::size_t waiting = 0;
};

/// The file in which the nodelet keeps what candidates may need. Writes never wait for the disk; what is in the way when the file is opened is named,
/// and it is tried again each ten seconds. Thread-safe.
class StageStore {
 public:
  /// An empty path: a temporary file, which goes with the object.
  explicit StageStore(std::string path);
  ~StageStore();
  StageStore(const StageStore&) = delete;
  StageStore& operator=(const StageStore&) = delete;

  /// Opens the file where it is time to try. True once: when it could be opened.
  bool open();
  bool isOpen() const;
  /// Lost, and counted, where there is no room or the file is not open.
  void post(urban_nav_store::LiveWriter::Write write);
  /// Returns when all that was posted before is committed, or could not be.
  void flush();
  StoreState state() const;

 private:
  using Clock = std::chrono::steady_clock;
  std::shared_ptr<urban_nav_store::LiveWriter> writer() const;

  const bool temporary_;
  mutable std::mutex mutex_;  // guards everything below
  std::string path_, folder_, fault_;
  std::shared_ptr<urban_nav_store::LiveWriter> writer_;
  std::optional<Clock::time_point> tried_;
  std::int64_t lost_ = 0;
};

}  // namespace loop_metric
