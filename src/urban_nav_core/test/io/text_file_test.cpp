// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/text_file.hpp"

#include <filesystem>
#include <utility>
#include <vector>

#include "io/reader_check.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/testing/limited_memory.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core {
namespace {

using Lines = std::vector<std::pair<std::string, int>>;

Lines toLines(std::string_view text) {
  Lines lines;
  forEachLine(text, [&lines](std::string_view line, int number) { lines.emplace_back(line, number); });
  return lines;
}

TEST(TextFile, LinesCountFromOneWhateverTheirEnds) {
  EXPECT_EQ(toLines("a\nb\r\n\nc"), (Lines{{"a", 1}, {"b", 2}, {"", 3}, {"c", 4}}));
  EXPECT_EQ(toLines("a\n"), (Lines{{"a", 1}}));
  EXPECT_EQ(toLines(""), Lines{});
}

TEST(TextFile, LinesOfOldMacintoshFilesEndInCarriageReturns) {
  EXPECT_EQ(toLines("a\rb\r\rc"), (Lines{{"a", 1}, {"b", 2}, {"", 3}, {"c", 4}}));
}

std::string asUtf16(const std::u16string& text, bool is_big_endian, bool has_mark) {
  std::string bytes;
  for (const char16_t unit : (has_mark ? u"\uFEFF" : u"") + text) {
    const char high = static_cast<char>(unit >> 8U), low = static_cast<char>(unit & 0xFFU);
    bytes += {is_big_endian ? high : low, is_big_endian ? low : high};
  }
  return bytes;
}

TEST(TextFile, EveryEncodingGivesTheText) {
  const std::string text = "x;\xC3\xA9;\xE2\x82\xAC;\xF0\x9F\x98\x80 and letters of ASCII\r\n1;2;3;4\r\n";
  const std::u16string wide = u"x;\u00E9;\u20AC;\U0001F600 and letters of ASCII\r\n1;2;3;4\r\n";
  EXPECT_EQ(decodeText(text), text);
  EXPECT_EQ(decodeText("\xEF\xBB\xBF" + text), text);
  for (const bool is_big_endian : {false, true})
    for (const bool has_mark : {false, true}) EXPECT_EQ(decodeText(asUtf16(wide, is_big_endian, has_mark)), text);
  EXPECT_EQ(decodeText(std::string("\0\0a\0b\0\0c", 8)), std::string("\0\0a\0b\0\0c", 8)) << "no text in UTF-16";
  const std::string broken = asUtf16(u"half a pair \xD83D", false, true);
  EXPECT_EQ(decodeText(broken), "half a pair \xEF\xBF\xBD");
}

TEST(TextFile, ReadsAllBytes) {
  const std::string path = (std::filesystem::temp_directory_path() / "urban_nav_text_file").string();
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{1}, std::size_t{65535}, std::size_t{65536}, std::size_t{200001}}) {
    std::string content(size, 'x');
    if (size > 1) content[size / 2] = '\0';
    writeAtomically(path, content);
    EXPECT_EQ(readTextFile(path), content) << size;
    EXPECT_EQ(readBytes(path), content) << size;
  }
  std::filesystem::remove(path);
}

TEST(TextFile, NamesTheFileThatCannotBeRead) {
  EXPECT_EQ(catchError([] { readTextFile("/nowhere/poses.txt"); }),
            "/nowhere/poses.txt: cannot be read: No such file or directory");
  EXPECT_EQ(catchError([] { readTextFile("/tmp"); }), "/tmp: is a folder: expected a text file");
}

TEST(TextFile, FilesThatDoNotFitIntoMemoryAreRefused) {
  const testing::LimitedMemory limit(std::size_t{4} << 20U);
  const std::string path = (std::filesystem::temp_directory_path() / "large_text_file").string();
  writeAtomically(path, std::string(std::size_t{2} << 20U, 'x'));
  EXPECT_EQ(readBytes(path).size(), std::size_t{2} << 20U);
  std::filesystem::resize_file(path, std::uintmax_t{1} << 40U);  // takes no room on the disk
  EXPECT_THROW(readBytes(path), UserError);
  EXPECT_THROW(readBytes("/dev/zero"), UserError) << "has no size";
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace urban_nav_core
