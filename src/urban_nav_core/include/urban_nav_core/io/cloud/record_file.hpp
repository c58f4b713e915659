// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>

#include "urban_nav_core/io/atomic_file.hpp"

namespace urban_nav_core {

/// File of fixed-size records after a header that is written last. The file is written completely or not at all. Not
/// thread-safe. Throws UserError or DataError naming the path.
class RecordFile {
 public:
  RecordFile(const std::string& path, std::size_t header_bytes, std::size_t record_bytes);
  ~RecordFile();
  RecordFile(const RecordFile&) = delete;
  RecordFile& operator=(const RecordFile&) = delete;

  /// Appends records. Requires a whole number of them.
  void append(std::string_view records);
  std::size_t records() const { return records_; }
  /// Writes the header and renames the file to its final name. Requires a header of `header_bytes`.
  void commit(std::string_view header);

 private:
  void write(std::string_view bytes);

  std::string path_;
  PartialFile partial_;
  std::FILE* file_ = nullptr;
  std::size_t header_bytes_ = 0, record_bytes_ = 0, records_ = 0;
};

}  // namespace urban_nav_core
