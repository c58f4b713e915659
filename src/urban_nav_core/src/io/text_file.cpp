// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/text_file.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>
#include <optional>

#include "urban_nav_core/io/memory_limit.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core {
namespace {

enum class ByteOrder { LittleEndian, BigEndian };

constexpr std::size_t kRare = 10;           // ratio of zero counts in even and odd bytes that identifies UTF-16
constexpr std::size_t kSampledStart = 512;  // bytes at the beginning, to recognise UTF-16 without a mark

/// Returns the byte order of UTF-16, and in `mark` the length of its byte order mark; nullopt for other encodings.
/// Without a mark, the upper bytes of ASCII characters are zero.
std::optional<ByteOrder> findUtf16(std::string_view bytes, std::size_t& mark) {
  mark = 2;
  if (bytes.substr(0, 2) == "\xFF\xFE") return ByteOrder::LittleEndian;
  if (bytes.substr(0, 2) == "\xFE\xFF") return ByteOrder::BigEndian;
  mark = 0;
  const std::size_t sampled = std::min(bytes.size(), kSampledStart) / 2 * 2;
  std::array<std::size_t, 2> zeros{};
  for (std::size_t i = 0; i < sampled; ++i) zeros[i % 2] += bytes[i] == '\0' ? 1 : 0;
  const std::size_t most = sampled / 2 - sampled / 8;
  if (sampled < 4 || std::max(zeros[0], zeros[1]) < most ||
      kRare * std::min(zeros[0], zeros[1]) > std::max(zeros[0], zeros[1]))
    return std::nullopt;
  return zeros[1] > zeros[0] ? ByteOrder::LittleEndian : ByteOrder::BigEndian;
}

void appendUtf8(std::string& text, std::uint32_t code) {
  const auto continued = [&text, code](unsigned shift) {
    text += static_cast<char>(0x80U | ((code >> shift) & 0x3FU));
  };
  if (code < 0x80U) {
    text += static_cast<char>(code);
  } else if (code < 0x800U) {
    text += static_cast<char>(0xC0U | (code >> 6U));
    continued(0);
  } else if (code < 0x10000U) {
    text += static_cast<char>(0xE0U | (code >> 12U));
    continued(6);
    continued(0);
  } else {
    text += static_cast<char>(0xF0U | (code >> 18U));
    continued(12);
    continued(6);
    continued(0);
  }
}

std::string utf16ToUtf8(std::string_view bytes, ByteOrder order) {
  constexpr std::uint32_t kReplacement = 0xFFFDU;  // for an unpaired surrogate
  const std::size_t high = order == ByteOrder::BigEndian ? 0 : 1;
  const auto unit = [&](std::size_t i) {
    return static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[2 * i + high])) << 8U |
           static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[2 * i + 1 - high]));
  };
  std::string text;
  text.reserve(bytes.size() / 2);
  const std::size_t units = bytes.size() / 2;
  for (std::size_t i = 0; i < units; ++i) {
    std::uint32_t code = unit(i);
    if (code >= 0xD800U && code < 0xE000U) {
      const std::uint32_t low = code < 0xDC00U && i + 1 < units ? unit(i + 1) : 0U;
      const bool is_pair = low >= 0xDC00U && low < 0xE000U;
      code = is_pair ? 0x10000U + ((code - 0xD800U) << 10U) + (low - 0xDC00U) : kReplacement;
      if (is_pair) ++i;
    }
    appendUtf8(text, code);
  }
  return text;
}

}  // namespace

std::string readBytes(const std::string& path) {
  const auto fail = [&path](int code) {
    if (code == EISDIR) throw UserError(path, "is a folder", "a text file");
    throw UserError(path, std::string("cannot be read: ") + std::strerror(code), "");
  };
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) fail(errno);
  constexpr std::size_t kPiece = 1U << 16U;
  std::string text;
  struct stat status = {};  // reserves the whole file at once: a growing text takes three times as much
  if (::fstat(::fileno(file.get()), &status) == 0 && S_ISREG(status.st_mode))
    text.reserve(std::min(static_cast<std::size_t>(status.st_size), memoryLimit() / 2) + 2 * kPiece);
  std::size_t got = kPiece;
  while (got == kPiece) {
    const std::size_t before = text.size();
    text.resize(before + kPiece);
    got = std::fread(&text[before], 1, kPiece, file.get());
    text.resize(before + got);
    if (text.size() > memoryLimit() / 2)
      throw UserError(path, "more than " + std::to_string(memoryLimit() >> 21U) + " MB",
                      "half of memory_mb = " + std::to_string(memoryLimit() >> 20U));
  }
  if (std::ferror(file.get()) != 0) fail(errno != 0 ? errno : EIO);
  return text;
}

std::string readTextFile(const std::string& path) { return decodeText(readBytes(path)); }

std::string decodeText(std::string bytes) {
  std::size_t mark = 0;
  if (const auto order = findUtf16(bytes, mark)) return utf16ToUtf8(std::string_view(bytes).substr(mark), *order);
  if (bytes.compare(0, 3, "\xEF\xBB\xBF") == 0) bytes.erase(0, 3);
  return bytes;
}

void forEachLine(std::string_view text, const std::function<void(std::string_view line, int number)>& line) {
  int number = 0;
  std::size_t begin = 0;
  const char end_of_line = text.find('\n') == std::string_view::npos ? '\r' : '\n';
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find(end_of_line, begin), text.size());
    std::string_view content = text.substr(begin, end - begin);
    if (!content.empty() && content.back() == '\r') content.remove_suffix(1);
    line(content, ++number);
    begin = end + 1;
  }
}

}  // namespace urban_nav_core
