// SPDX-License-Identifier: BSD-3-Clause
#include "recording/storage/packed_message.hpp"

#include <zstd.h>

#include <cstring>

#include "urban_nav_core/io/memory_limit.hpp"

namespace urban_nav_input {

namespace {

constexpr std::uint8_t kZstdMagic[] = {0x28, 0xb5, 0x2f, 0xfd};
constexpr std::size_t kFirstGuess = 4;  // times the compressed size, if the frame does not hold its size

}  // namespace

bool isZstd(ByteView bytes) {
  return bytes.size >= sizeof(kZstdMagic) && std::memcmp(bytes.data, kZstdMagic, sizeof(kZstdMagic)) == 0;
}

ByteView MessageUnpacker::operator()(ByteView message) {
  static constexpr std::uint8_t kEmpty = 0;  // an empty message is no damaged one
  if (message.data == nullptr) return {&kEmpty, 0};
  if (!isZstd(message)) return message;
  const unsigned long long size = ZSTD_getFrameContentSize(message.data, message.size);
  if (size == ZSTD_CONTENTSIZE_ERROR) return {};
  if (size != ZSTD_CONTENTSIZE_UNKNOWN) {
    inflated_ = inflate("zstd", message, static_cast<std::size_t>(size));
    return inflated_.is_whole ? inflated_.bytes() : ByteView{};
  }
  for (std::size_t capacity = kFirstGuess * message.size; capacity <= urban_nav_core::largestPiece(); capacity *= 2) {
    inflated_ = inflate("zstd", message, capacity);
    if (inflated_.size < capacity) return inflated_.size > 0 ? inflated_.bytes() : ByteView{};
  }
  return {};
}

}  // namespace urban_nav_input
