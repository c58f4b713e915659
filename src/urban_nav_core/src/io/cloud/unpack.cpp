// SPDX-License-Identifier: BSD-3-Clause
#include <zlib.h>

#include <algorithm>
#include <memory>

#include "formats.hpp"
#include "urban_nav_core/io/memory_limit.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/io/unpacked_file.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core::cloud_formats {

bool isGzip(std::string_view content) { return content.substr(0, 2) == "\x1f\x8b"; }

std::size_t countLines(std::string_view content) {
  return static_cast<std::size_t>(std::count(content.begin(), content.end(), '\n'));
}

std::string gunzip(std::string_view content, const std::string& name) {
  constexpr std::size_t kPiece = 1U << 20U;
  const std::size_t limit = largestPiece();
  z_stream stream{};
  if (inflateInit2(&stream, 15 + 16) != Z_OK) throw UserError(name, "cannot be unpacked", "");
  const std::unique_ptr<z_stream, int (*)(z_stream*)> guard(&stream, &inflateEnd);
  std::string plain;
  std::size_t taken = 0;
  while (taken < content.size()) {  // a gzip file may have several members
    int status = Z_OK;
    while (status != Z_STREAM_END) {
      if (stream.avail_in == 0 && taken < content.size()) {
        const std::size_t piece = std::min(kPiece, content.size() - taken);
        stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(content.data() + taken));
        stream.avail_in = static_cast<uInt>(piece);
        taken += piece;
      }
      const std::size_t before = plain.size();
      plain.resize(before + kPiece);
      stream.next_out = reinterpret_cast<Bytef*>(&plain[before]);
      stream.avail_out = static_cast<uInt>(kPiece);
      status = inflate(&stream, Z_NO_FLUSH);
      plain.resize(before + kPiece - stream.avail_out);
      if (status == Z_BUF_ERROR) throw UserError(name, "the gzip stream ends too early", "a complete file");
      if (status != Z_OK && status != Z_STREAM_END)
        throw UserError(name, "the gzip stream is damaged", "a complete file");
      if (plain.size() > limit)
        throw UserError(name, "more than " + std::to_string(limit >> 20U) + " MB when unpacked",
                        "an eighth of memory_mb = " + std::to_string(memoryLimit() >> 20U) + "; or the unpacked file");
    }
    taken -= stream.avail_in;
    stream.avail_in = 0;
    if (!isGzip(content.substr(taken))) break;  // padding after the last member
    if (inflateReset(&stream) != Z_OK) throw UserError(name, "cannot be unpacked", "");
  }
  return plain;
}

std::optional<std::string> decompressLzf(std::string_view packed, std::size_t size) {
  std::string plain;
  plain.reserve(size);
  std::size_t at = 0;
  const auto byte = [&] { return static_cast<unsigned char>(packed[at++]); };
  while (at < packed.size()) {
    const unsigned control = byte();
    if (control < 32) {
      const std::size_t length = control + 1;
      if (length > packed.size() - at || length > size - plain.size()) return std::nullopt;
      plain.append(packed.substr(at, length));
      at += length;
      continue;
    }
    std::size_t length = control >> 5U;
    if (length == 7) {
      if (at >= packed.size()) return std::nullopt;
      length += byte();
    }
    if (at >= packed.size()) return std::nullopt;
    const std::size_t back = ((control & 31U) << 8U) + byte() + 1;
    length += 2;
    if (back > plain.size() || length > size - plain.size()) return std::nullopt;
    for (std::size_t i = 0; i < length; ++i) plain.push_back(plain[plain.size() - back]);  // may overlap its own output
  }
  if (plain.size() != size) return std::nullopt;
  return plain;
}

}  // namespace urban_nav_core::cloud_formats

namespace urban_nav_core {

std::string readUnpacked(const std::string& path) {
  std::string bytes = readBytes(path);
  return cloud_formats::isGzip(bytes) ? cloud_formats::gunzip(bytes, path) : bytes;
}

}  // namespace urban_nav_core
