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

 private:
  ByteView bytes_;
};

}  // namespace urban_nav_input
