// SPDX-License-Identifier: BSD-3-Clause
#include "recording/storage/unpacked_file.hpp"

#include <unistd.h>
#include <zstd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <memory>
#include <vector>

#include "recording/storage/mapped_file.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_input {

namespace {

constexpr std::uint64_t kLeastRoom = std::uint64_t{64} << 20U,
                        kMostGain = 1000;  // bytes, and times the compressed file

/// Decompresses all frames; `write` receives bytes and returns whether to continue. Returns whether the input ends with
/// the end of a frame.
template <typename Write>
bool inflateAll(ByteView packed, const Write& write) {
  const std::unique_ptr<ZSTD_DCtx, std::size_t (*)(ZSTD_DCtx*)> context(ZSTD_createDCtx(), ZSTD_freeDCtx);
  std::vector<char> block(ZSTD_DStreamOutSize());
  ZSTD_inBuffer in{packed.data, packed.size, 0};
  std::size_t hint = 1;
  bool is_full = false;  // there may be more output for the input
  while (in.pos < in.size || is_full) {
    ZSTD_outBuffer out{block.data(), block.size(), 0};
    const std::size_t read = in.pos;
    hint = ZSTD_decompressStream(context.get(), &out, &in);
    if (ZSTD_isError(hint) != 0) return false;
    if (out.pos == 0 && in.pos == read) break;
    is_full = out.pos == out.size;
    if (!write(block.data(), out.pos)) return true;
  }
  return hint == 0;
}

}  // namespace

std::string peekZstdFile(const std::string& path, std::size_t size) {
  const MappedFile file(path);
  std::string begin;
  inflateAll(file.bytes(), [&](const char* bytes, std::size_t count) {
    begin.append(bytes, count);
    return begin.size() < size;
  });
  begin.resize(std::min(begin.size(), size));
  return begin;
}

UnpackedFile::UnpackedFile(const std::string& path) {
  const MappedFile file(path);
  path_ = (std::filesystem::temp_directory_path() / "urban_nav-XXXXXX").string();
  const int descriptor = mkstemp(path_.data());
  const auto fail = [&] {
    const int error = errno;
    if (descriptor >= 0) {
      close(descriptor);
      unlink(path_.c_str());
    }
    throw urban_nav_core::DataError(path, "cannot be decompressed to " + path_ + ": " + std::strerror(error),
                                    "room in TMPDIR");
  };
  if (descriptor < 0) fail();
  // Recordings usually compress to a fifth, and to a hundredth without motion.
  std::uint64_t room = kLeastRoom + kMostGain * std::uint64_t{file.bytes().size};
  is_whole_ = inflateAll(file.bytes(), [&](const char* bytes, std::size_t count) {
    if (count > room) {
      errno = EFBIG;
      fail();
    }
    room -= count;
    while (count > 0) {
      const ssize_t written = ::write(descriptor, bytes, count);
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail();
      bytes += written;
      count -= static_cast<std::size_t>(written);
    }
    return true;
  });
  close(descriptor);
}

UnpackedFile::~UnpackedFile() { unlink(path_.c_str()); }

}  // namespace urban_nav_input
