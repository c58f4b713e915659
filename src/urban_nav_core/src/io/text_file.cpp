// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/text_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core {

std::string readTextFile(const std::string& path) {
  const auto fail = [&path](int code) {
    if (code == EISDIR) throw UserError(path, "is a folder", "a text file");
    throw UserError(path, std::string("cannot be read: ") + std::strerror(code), "");
  };
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) fail(errno);
  constexpr std::size_t kPiece = 1U << 16U;
  std::string text;
  std::size_t got = kPiece;
  while (got == kPiece) {
    const std::size_t before = text.size();
    text.resize(before + kPiece);
    got = std::fread(&text[before], 1, kPiece, file.get());
    text.resize(before + got);
  }
  if (std::ferror(file.get()) != 0) fail(errno != 0 ? errno : EIO);
  if (text.compare(0, 3, "\xEF\xBB\xBF") == 0) text.erase(0, 3);  // byte order mark of UTF-8
  return text;
}

void forEachLine(std::string_view text, const std::function<void(std::string_view line, int number)>& line) {
  int number = 0;
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::string_view content = text.substr(begin, end - begin);
    if (!content.empty() && content.back() == '\r') content.remove_suffix(1);
    line(content, ++number);
    begin = end + 1;
  }
}

}  // namespace urban_nav_core
