// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_store/deflate.hpp"

#include <zlib.h>

#include <algorithm>
#include <new>

#include "urban_nav_core/io/memory_limit.hpp"
#include "urban_nav_store/bytes.hpp"

namespace urban_nav_store {

namespace {
constexpr int kLevel = 3;
constexpr std::size_t kLengthBytes = sizeof(std::uint64_t);
constexpr std::size_t kMostGain = 1100;  // the largest compression ratio of deflate is 1032 (zlib's technical notes)
}  // namespace

std::string deflated(std::string_view bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string result;
  appendInteger(result, bytes.size());
  result.resize(kLengthBytes + size);
  const int code = compress2(reinterpret_cast<Bytef*>(result.data() + kLengthBytes), &size,
                             reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uLong>(bytes.size()), kLevel);
  if (code != Z_OK) throw std::bad_alloc();  // the only possible error of compress2
  result.resize(kLengthBytes + size);
  return result;
}

std::optional<std::string> inflated(std::string_view bytes, std::size_t limit) {
  ByteReader reader(bytes);
  const std::uint64_t length = reader.integer();
  if (!reader.ok() || length > std::min(limit, urban_nav_core::memoryLimit() / 2) ||
      length > kMostGain * reader.left() + kMostGain)
    return std::nullopt;
  std::string result(static_cast<std::size_t>(length), '\0');
  uLongf size = static_cast<uLongf>(length);
  char nothing = 0;
  const int code = uncompress(reinterpret_cast<Bytef*>(length > 0 ? result.data() : &nothing), &size,
                              reinterpret_cast<const Bytef*>(bytes.data() + kLengthBytes),
                              static_cast<uLong>(bytes.size() - kLengthBytes));
  if (code != Z_OK || size != length) return std::nullopt;
  return result;
}

}  // namespace urban_nav_store
