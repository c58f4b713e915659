// SPDX-License-Identifier: BSD-3-Clause
#include "recording/storage/mapped_file.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav_input {

namespace {

constexpr std::size_t kMostMapped = std::size_t{64} << 20U;  // bytes
constexpr std::size_t kAround = std::size_t{64} << 10U;      // bytes mapped by Linux around an accessed one

[[noreturn]] void fail(const std::string& path, int error) {
  throw urban_nav_core::DataError(path, std::string("cannot be read: ") + std::strerror(error), "");
}

}  // namespace

MappedFile::MappedFile(const std::string& path) {
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) fail(path, errno);
  struct stat status = {};
  if (fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) {
    const int error = errno != 0 ? errno : EINVAL;
    close(descriptor);
    fail(path, error);
  }
  const auto size = static_cast<std::size_t>(status.st_size);
  void* memory = size == 0 ? nullptr : mmap(nullptr, size, PROT_READ, MAP_PRIVATE, descriptor, 0);
  const int error = errno;
  close(descriptor);
  if (memory == MAP_FAILED) fail(path, error);
  bytes_ = {static_cast<const std::uint8_t*>(memory), size};
}

MappedFile::~MappedFile() {
  if (bytes_.size > 0) munmap(const_cast<std::uint8_t*>(bytes_.data), bytes_.size);
}

void MappedFile::countRead(std::size_t size) {
  read_ += size + kAround;
  if (read_ < kMostMapped || bytes_.size == 0) return;
  read_ = 0;
  madvise(const_cast<std::uint8_t*>(bytes_.data), bytes_.size, MADV_DONTNEED);  // pages of a file can be read again
}

}  // namespace urban_nav_input
