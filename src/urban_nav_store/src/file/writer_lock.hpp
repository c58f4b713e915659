// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace urban_nav_store {

/// The right to write a store: one holder in all processes and within each, by a lock on FILE-lock. Ends with the
/// process, however that ends. SQLite's own locks would keep readers out for as long.
class WriterLock {
 public:
  /// UserError where another holds it.
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
