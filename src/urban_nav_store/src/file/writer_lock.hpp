// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace urban_nav_store {

/// Exclusive right to write a store, among all processes and within each, by a lock on FILE-lock. Released when the
/// process ends in any way. SQLite's own locks would block readers for as long.
class WriterLock {
 public:
  /// Throws UserError if another program or object holds the lock.
  explicit WriterLock(const std::string& path);
  ~WriterLock();
  WriterLock(const WriterLock&) = delete;
  WriterLock& operator=(const WriterLock&) = delete;

  static bool isHeld(const std::string& path);

 private:
  std::string lock_path_;
  int descriptor_ = -1;
};

}  // namespace urban_nav_store
