// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_input/recording/byte_view.hpp"

namespace urban_nav_input {

/// A read-only memory-mapped file. Thread-safe.
class MappedFile {
 public:
  /// Throws DataError naming the file if it cannot be read.
  explicit MappedFile(const std::string& path);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  ByteView bytes() const { return bytes_; }
  /// Counts read bytes, and returns pages to the system when there are many, so that a long recording does not count as
  /// memory of the process. Views stay valid: pages are read again on access. Not thread-safe.
  void countRead(std::size_t size);

 private:
  ByteView bytes_;
  std::size_t read_ = 0;  // bytes since pages were returned
};

}  // namespace urban_nav_input
