// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/text_file.hpp"

#include <filesystem>
#include <utility>
#include <vector>

#include "io/reader_check.hpp"
#include "urban_nav_core/io/atomic_file.hpp"

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

TEST(TextFile, ReadsAllBytes) {
  const std::string path = (std::filesystem::temp_directory_path() / "urban_nav_text_file").string();
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{1}, std::size_t{65535}, std::size_t{65536}, std::size_t{200001}}) {
    std::string content(size, 'x');
    if (size > 1) content[size / 2] = '\0';
    writeAtomically(path, content);
    EXPECT_EQ(readTextFile(path), content) << size;
  }
  std::filesystem::remove(path);
}

TEST(TextFile, NamesTheFileThatCannotBeRead) {
  EXPECT_EQ(catchError([] { readTextFile("/nowhere/poses.txt"); }),
            "/nowhere/poses.txt: cannot be read: No such file or directory");
  EXPECT_EQ(catchError([] { readTextFile("/tmp"); }), "/tmp: is a folder: allowed a text file");
}

}  // namespace
}  // namespace urban_nav_core
