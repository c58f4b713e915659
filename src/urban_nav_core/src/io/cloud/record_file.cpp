// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/cloud/record_file.hpp"

#include <cassert>
#include <cerrno>
#include <cstring>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core {

RecordFile::RecordFile(const std::string& path, std::size_t header_bytes, std::size_t record_bytes)
    : path_(path), partial_(path), header_bytes_(header_bytes), record_bytes_(record_bytes) {
  file_ = std::fopen(partial_.path().c_str(), "wb");
  if (file_ == nullptr) throw UserError(path_, std::string("cannot be written: ") + std::strerror(errno), "");
  write(std::string(header_bytes_, ' '));
}

RecordFile::~RecordFile() {
  if (file_ != nullptr) std::fclose(file_);
}

void RecordFile::write(std::string_view bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_) == bytes.size()) return;
  throw DataError(path_, std::string("cannot be written: ") + std::strerror(errno), "");
}

void RecordFile::append(std::string_view records) {
  assert(records.size() % record_bytes_ == 0);
  write(records);
  records_ += records.size() / record_bytes_;
}

void RecordFile::commit(std::string_view header) {
  assert(header.size() == header_bytes_);
  const bool at_start = std::fseek(file_, 0, SEEK_SET) == 0;
  if (at_start) write(header);
  const bool closed = std::fclose(file_) == 0;
  file_ = nullptr;
  if (!at_start || !closed) throw DataError(path_, std::string("cannot be written: ") + std::strerror(errno), "");
  partial_.commit();
}

}  // namespace urban_nav_core
