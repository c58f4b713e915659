// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_input/recording/byte_view.hpp"

namespace urban_nav_input {

/// A file as memory, read by the system where it is used; the file is never written. Thread-safe.
class MappedFile {
 public:
  /// Throws DataError naming the file if it cannot be read.
  explicit MappedFile(const std::string& path);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  ByteView bytes() const { return bytes_; }
  /// Counts bytes that are read, and returns the pages to the system once they are many: a long recording would count
  /// as memory of the process as a whole. Views stay valid: what is used again is read again. Not thread-safe.
  void countRead(std::size_t size);

 private:
  ByteView bytes_;
  std::size_t read_ = 0;  // bytes since pages were returned
};

}  // namespace urban_nav_input
