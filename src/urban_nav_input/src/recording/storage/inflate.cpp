// SPDX-License-Identifier: BSD-3-Clause
#include "recording/storage/inflate.hpp"

#include <bzlib.h>
#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>
#include <boost/make_unique.hpp>
#include <limits>
#include <new>

#include "urban_nav_core/io/memory_limit.hpp"

namespace urban_nav_input {

namespace {

void inflateZstd(ByteView packed, std::size_t capacity, Inflated& out) {
  static thread_local const std::unique_ptr<ZSTD_DCtx, std::size_t (*)(ZSTD_DCtx*)> context(ZSTD_createDCtx(),
                                                                                            ZSTD_freeDCtx);
  const std::size_t size = ZSTD_decompressDCtx(context.get(), out.memory.get(), capacity, packed.data, packed.size);
  if (ZSTD_isError(size) == 0) {
    out.size = size;
    out.is_whole = size == capacity;
    return;
  }
  ZSTD_DCtx_reset(context.get(), ZSTD_reset_session_only);
  ZSTD_inBuffer in{packed.data, packed.size, 0};
  ZSTD_outBuffer written{out.memory.get(), capacity, 0};
  while (in.pos < in.size) {
    const std::size_t read = in.pos, produced = written.pos;
    const std::size_t result = ZSTD_decompressStream(context.get(), &written, &in);
    if (ZSTD_isError(result) != 0 || (in.pos == read && written.pos == produced)) break;
  }
  ZSTD_DCtx_reset(context.get(), ZSTD_reset_session_only);
  out.size = written.pos;
}

void inflateLz4(ByteView packed, std::size_t capacity, Inflated& out) {
  LZ4F_dctx* raw = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&raw, LZ4F_VERSION)) != 0) throw std::bad_alloc();
  const std::unique_ptr<LZ4F_dctx, LZ4F_errorCode_t (*)(LZ4F_dctx*)> context(raw, LZ4F_freeDecompressionContext);
  LZ4F_decompressOptions_t options = {};
  options.stableDst = 1;
  std::size_t at = 0, hint = 1;
  while (at < packed.size) {
    std::size_t produced = capacity - out.size, read = packed.size - at;
    hint = LZ4F_decompress(context.get(), out.memory.get() + out.size, &produced, packed.data + at, &read, &options);
    if (LZ4F_isError(hint) != 0) return;
    out.size += produced;
    at += read;
    if (produced == 0 && read == 0) return;
  }
  out.is_whole = hint == 0 && out.size == capacity;
}

void inflateBz2(ByteView packed, std::size_t capacity, Inflated& out) {
  constexpr std::size_t kMost = std::numeric_limits<unsigned int>::max();
  bz_stream stream = {};
  if (BZ2_bzDecompressInit(&stream, 0, 0) != BZ_OK) throw std::bad_alloc();
  const std::unique_ptr<bz_stream, int (*)(bz_stream*)> at_end(&stream, BZ2_bzDecompressEnd);
  stream.next_in = const_cast<char*>(reinterpret_cast<const char*>(packed.data));  // bzlib does not write there
  stream.avail_in = static_cast<unsigned int>(std::min(packed.size, kMost));
  stream.next_out = reinterpret_cast<char*>(out.memory.get());
  stream.avail_out = static_cast<unsigned int>(std::min(capacity, kMost));
  int result = BZ_OK;
  while (result == BZ_OK && stream.avail_out > 0) {
    const unsigned int in = stream.avail_in, room = stream.avail_out;
    result = BZ2_bzDecompress(&stream);
    if (stream.avail_in == in && stream.avail_out == room) break;
  }
  out.size = std::min(capacity, kMost) - stream.avail_out;
  out.is_whole = (result == BZ_OK || result == BZ_STREAM_END) && out.size == capacity;
}

}  // namespace

bool isKnownCompression(const std::string& compression) {
  return compression.empty() || compression == "zstd" || compression == "lz4";
}

Inflated inflate(const std::string& compression, ByteView packed, std::size_t size) {
  Inflated out;
  if (size > urban_nav_core::largestPiece()) return out;
  // Not zero-initialised: pages are allocated when written, so that a damaged size costs nothing.
  out.memory = boost::make_unique_noinit<std::uint8_t[]>(size);
  if (size == 0) out.is_whole = true;
  else if (compression == "zstd") inflateZstd(packed, size, out);
  else if (compression == "bz2") inflateBz2(packed, size, out);
  else inflateLz4(packed, size, out);
  return out;
}

}  // namespace urban_nav_input
