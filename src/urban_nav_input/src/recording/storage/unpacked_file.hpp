// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "urban_nav_input/recording/byte_view.hpp"

namespace urban_nav_input {

/// Returns the first decompressed bytes of a zstd file, at most `size`; fewer if it is damaged or shorter.
std::string peekZstdFile(const std::string& path, std::size_t size);

/// A zstd file decompressed to a temporary one (in TMPDIR), which is removed with this object.
class UnpackedFile {
 public:
  /// Throws DataError naming the file if it cannot be read or written. A truncated or damaged file is
  /// decompressed up to the damage.
  explicit UnpackedFile(const std::string& path);
  ~UnpackedFile();
  UnpackedFile(const UnpackedFile&) = delete;
  UnpackedFile& operator=(const UnpackedFile&) = delete;

  const std::string& path() const { return path_; }
  bool isWhole() const { return is_whole_; }

 private:
  std::string path_;
  bool is_whole_ = false;
};

}  // namespace urban_nav_input
