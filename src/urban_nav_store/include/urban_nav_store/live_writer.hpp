// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "urban_nav_store/store.hpp"

namespace urban_nav_store {

/// Keeps a store off the hot path of a live robot: writes are posted, a thread of its own carries them out in the
/// order of posting and commits once a period. Thread-safe.
class LiveWriter {
 public:
  using Write = std::function<void(Store&)>;
  struct Options {
    std::size_t capacity = 20000;  ///< writes that wait or are not yet committed; more are dropped and counted
    std::chrono::milliseconds period{1000};  ///< between commits
  };
  struct Counts {
    std::int64_t committed = 0;  ///< writes
    std::int64_t dropped = 0;    ///< for want of room in the queue
    std::int64_t refused = 0;    ///< by the store: what is not finite, say
    std::size_t waiting = 0;     ///< not yet committed
    /// Why the last attempt to commit failed, or the last write was refused; empty when all is well. On a full disk the writes stay in
    /// the queue and are tried again each period.
    std::string fault;
  };

  /// `store` must have no other user from now on.
  LiveWriter(Store store, const Options& options);
  /// Commits what can be committed and closes the store.
  ~LiveWriter();

  /// Never blocks for the disk. False where the queue is full. A write that throws is taken back and counted as refused; it
  /// may be called a second time where a commit failed.
  bool post(Write write);
  /// Returns when all that was posted before is committed, or could not be.
  void flush();
  Counts counts() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace urban_nav_store
