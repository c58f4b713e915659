// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "urban_nav_store/store.hpp"

namespace urban_nav_store {

/// Writes to a store in a background thread: posted writes are executed in order and committed once per period.
/// Thread-safe.
class LiveWriter {
 public:
  using Write = std::function<void(Store&)>;
  struct Options {
    std::size_t capacity = 20000;  ///< writes queued or not yet committed; further ones are dropped and counted
    std::chrono::milliseconds period{1000};  ///< between commits
  };
  struct Counts {
    std::int64_t committed = 0;  ///< writes
    std::int64_t dropped = 0;    ///< because the queue was full
    std::int64_t refused = 0;    ///< rejected by the store, for example non-finite values
    std::size_t waiting = 0;     ///< not yet committed
    /// Reason why the last commit failed or the last write was refused; empty otherwise. On a full disk the writes
    /// remain queued and are retried each period.
    std::string fault;
  };

  /// Requires exclusive use of `store`.
  LiveWriter(Store store, const Options& options);
  /// Commits queued writes if possible and closes the store.
  ~LiveWriter();

  /// Queues a write. Never blocks on the disk. Returns false if the queue is full. A write that throws is rolled back
  /// and counted as refused; a write may be called again after a failed commit.
  bool post(Write write);
  /// Blocks until all writes posted before are committed or have failed.
  void flush();
  Counts counts() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace urban_nav_store
