// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/image_header.hpp"

#include <algorithm>
#include <limits>
#include <map>

#include "urban_nav_core/io/memory_limit.hpp"

namespace urban_nav_core {

namespace {

/// Reads numbers of a file in either byte order; `good` becomes false after a read beyond the end.
class Bytes {
 public:
  Bytes(std::string_view file, bool is_big_endian) : file_(file), is_big_endian_(is_big_endian) {}

  std::uint64_t number(std::size_t at, std::size_t size) {
    if (at > file_.size() || size > file_.size() - at) {
      good = false;
      return 0;
    }
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < size; ++i)
      value = value << 8U | static_cast<unsigned char>(file_[at + (is_big_endian_ ? i : size - 1 - i)]);
    return value;
  }

  bool good = true;

 private:
  std::string_view file_;
  bool is_big_endian_;
};

/// Returns the product, saturated.
std::uint64_t product(std::initializer_list<std::uint64_t> factors) {
  std::uint64_t result = 1;
  for (const std::uint64_t factor : factors) {
    if (factor != 0 && result > std::numeric_limits<std::uint64_t>::max() / factor)
      return std::numeric_limits<std::uint64_t>::max();
    result *= factor;
  }
  return result;
}

std::optional<ImageHeader> finished(const Bytes& bytes, ImageHeader header) {
  if (!bytes.good || header.width == 0 || header.height == 0) return std::nullopt;
  return header;
}

// ISO/IEC 15948, 11.2.2. Colour types: 0 grey, 2 colour, 3 palette (decoded to colour); 4 and 6 with alpha.
std::optional<ImageHeader> parsePng(std::string_view file) {
  Bytes bytes(file, true);
  if (bytes.number(12, 4) != 0x49484452) return std::nullopt;  // IHDR
  ImageHeader header{bytes.number(16, 4), bytes.number(20, 4), 0};
  const std::uint64_t depth = bytes.number(24, 1) > 8 ? 2 : 1;
  const std::uint64_t colour = bytes.number(25, 1), channels = colour == 0 ? 1 : colour <= 3 ? 3 : 4;
  header.bytes = product({header.width, header.height, channels, depth});
  return finished(bytes, header);
}

// ITU-T T.81, annex B.2.2. A progressive image additionally requires two-byte coefficients.
std::optional<ImageHeader> parseJpeg(std::string_view file) {
  Bytes bytes(file, true);
  for (std::size_t at = 2; bytes.good;) {
    if (bytes.number(at, 1) != 0xff) return std::nullopt;
    const std::uint64_t marker = bytes.number(at + 1, 1);
    if (marker == 0xff) {  // a fill byte
      ++at;
      continue;
    }
    const bool is_frame = marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
    if (is_frame) {
      ImageHeader header{bytes.number(at + 7, 2), bytes.number(at + 5, 2), 0};
      const std::uint64_t components = bytes.number(at + 9, 1);
      const bool is_sequential = marker <= 0xc1;
      header.bytes = product({header.width, header.height, 3 + (is_sequential ? 0 : 2 * components)});
      return finished(bytes, header);
    }
    if (marker == 0xd9 || marker == 0xda) return std::nullopt;  // the end, or a scan without a frame
    const bool has_length = marker != 0x01 && !(marker >= 0xd0 && marker <= 0xd8);
    const std::uint64_t length = has_length ? bytes.number(at + 2, 2) : 0;
    if (has_length && length < 2) return std::nullopt;
    at += 2 + static_cast<std::size_t>(length);
  }
  return std::nullopt;
}

// TIFF 6.0, section 2: fields of the first directory, each with its first value.
std::optional<ImageHeader> parseTiff(std::string_view file) {
  constexpr std::uint64_t kWidth = 256, kHeight = 257, kBits = 258, kSamples = 277, kTileWidth = 322, kTileHeight = 323;
  constexpr std::uint64_t kShort = 3;
  Bytes bytes(file, file[0] == 'M');
  const auto directory = static_cast<std::size_t>(bytes.number(4, 4));
  const std::uint64_t fields = bytes.number(directory, 2);
  std::map<std::uint64_t, std::uint64_t> values = {{kBits, 1}, {kSamples, 1}};
  for (std::size_t i = 0; i < fields && bytes.good; ++i) {
    const std::size_t at = directory + 2 + 12 * i;
    const std::uint64_t tag = bytes.number(at, 2), size = bytes.number(at + 2, 2) == kShort ? 2 : 4;
    std::size_t place = at + 8;
    if (product({bytes.number(at + 4, 4), size}) > 4) place = static_cast<std::size_t>(bytes.number(at + 8, 4));
    const bool is_wanted =
        tag == kWidth || tag == kHeight || tag == kBits || tag == kSamples || tag == kTileWidth || tag == kTileHeight;
    if (is_wanted) values[tag] = bytes.number(place, static_cast<std::size_t>(size));
  }
  const std::uint64_t sample = product({std::max<std::uint64_t>(values[kSamples], 4), (values[kBits] + 7) / 8});
  ImageHeader header{values[kWidth], values[kHeight], 0};
  header.bytes = std::max(product({header.width, header.height, sample}),
                          product({values[kTileWidth], values[kTileHeight], sample}));
  return finished(bytes, header);
}

// BITMAPINFOHEADER, or the older BITMAPCOREHEADER of 12 bytes. A negative height means rows from the top.
std::optional<ImageHeader> parseBmp(std::string_view file) {
  Bytes bytes(file, false);
  const std::size_t size = bytes.number(14, 4) == 12 ? 2 : 4;
  ImageHeader header{bytes.number(18, size), bytes.number(18 + size, size), 0};
  if (size == 4 && header.height >= 0x80000000U) header.height = 0x100000000U - header.height;
  header.bytes = product({header.width, header.height, 4});
  return finished(bytes, header);
}

// netpbm's P1 to P6: words separated by blanks, and comments from # to the end of the line.
std::optional<ImageHeader> parsePnm(std::string_view file) {
  const bool is_bitmap = file[1] == '1' || file[1] == '4';
  std::uint64_t numbers[3] = {0, 0, 1};
  std::size_t at = 2;
  for (std::size_t i = 0; i < (is_bitmap ? 2U : 3U); ++i) {
    const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; };
    while (at < file.size() && (file[at] == '#' || is_blank(file[at])))
      at = file[at] == '#' ? std::min(file.find('\n', at), file.size()) : at + 1;
    if (at >= file.size() || file[at] < '0' || file[at] > '9') return std::nullopt;
    for (numbers[i] = 0; at < file.size() && file[at] >= '0' && file[at] <= '9'; ++at) {
      numbers[i] = 10 * numbers[i] + static_cast<std::uint64_t>(file[at] - '0');
      if (numbers[i] > std::numeric_limits<std::uint32_t>::max()) return std::nullopt;
    }
  }
  ImageHeader header{numbers[0], numbers[1], 0};
  header.bytes = product({header.width, header.height, 3, numbers[2] > 255 ? 2U : 1U});
  return header.width == 0 || header.height == 0 ? std::nullopt : std::optional<ImageHeader>(header);
}

bool startsWith(std::string_view file, std::string_view magic) { return file.substr(0, magic.size()) == magic; }

}  // namespace

std::optional<ImageHeader> parseImageHeader(std::string_view file) {
  using namespace std::string_view_literals;
  if (startsWith(file, "\x89PNG\r\n\x1a\n")) return parsePng(file);
  if (startsWith(file, "\xff\xd8")) return parseJpeg(file);
  if (startsWith(file, "II*\0"sv) || startsWith(file, "MM\0*"sv)) return parseTiff(file);
  if (startsWith(file, "BM")) return parseBmp(file);
  if (file.size() > 2 && file[0] == 'P' && file[1] >= '1' && file[1] <= '6') return parsePnm(file);
  return std::nullopt;
}

std::string imageFault(std::string_view file) {
  const std::optional<ImageHeader> header = parseImageHeader(file);
  if (!header) return "is not a PNG, JPEG, TIFF, BMP or PNM file with an intact header";
  if (header->bytes <= largestImage()) return {};
  return std::to_string(header->width) + " x " + std::to_string(header->height) + " pixels exceed the " +
         std::to_string(largestImage() >> 20U) + " MB that memory_mb = " + std::to_string(memoryLimit() >> 20U) +
         " leaves for one image";
}

std::string imageFault(const void* data, std::size_t size) {
  return imageFault(std::string_view(static_cast<const char*>(data), size));
}

}  // namespace urban_nav_core
