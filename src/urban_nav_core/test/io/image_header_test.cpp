// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/image_header.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "urban_nav_core/testing/fuzz.hpp"
#include "urban_nav_core/testing/limited_memory.hpp"

namespace urban_nav_core {
namespace {

using testing::LimitedMemory;

std::string bigEndian(std::uint32_t number, int bytes) {
  std::string text;
  for (int i = bytes; i-- > 0;) text += static_cast<char>(number >> (8 * i) & 0xffU);
  return text;
}
std::string littleEndian(std::uint32_t number, int bytes) {
  const std::string text = bigEndian(number, bytes);
  return {text.rbegin(), text.rend()};
}

std::string png(std::uint32_t width, std::uint32_t height, char depth = 8) {
  return "\x89PNG\r\n\x1a\n" + bigEndian(13, 4) + "IHDR" + bigEndian(width, 4) + bigEndian(height, 4) + depth +
         std::string("\x02\0\0\0", 4);
}
/// `frame`: the marker of the frame, c0 sequential, c2 progressive. A comment and a fill byte come before it.
std::string jpeg(std::uint32_t width, std::uint32_t height, char frame = '\xc0') {
  return std::string("\xff\xd8\xff\xfe\0\x04hi\xff\xff", 10) + frame + bigEndian(17, 2) + "\x08" +
         bigEndian(height, 2) + bigEndian(width, 2) + "\x03" + std::string(9, '\0');
}
std::string bmp(std::uint32_t width, std::uint32_t height) {
  return "BM" + std::string(12, '\0') + littleEndian(40, 4) + littleEndian(width, 4) + littleEndian(height, 4) +
         std::string(28, '\0');
}
/// Fields of TIFF: tag, type 4 (four bytes each), one value.
std::string tiff(const std::vector<std::pair<std::uint32_t, std::uint32_t>>& fields) {
  std::string text =
      "II*" + std::string(1, '\0') + littleEndian(8, 4) + littleEndian(static_cast<std::uint32_t>(fields.size()), 2);
  for (const auto& [tag, value] : fields)
    text += littleEndian(tag, 2) + littleEndian(4, 2) + littleEndian(1, 4) + littleEndian(value, 4);
  return text;
}

TEST(ImageHeader, SizeIsReadOfEachFormat) {
  for (const std::string& file : {png(640, 480), jpeg(640, 480), jpeg(640, 480, '\xc2'), bmp(640, 480),
                                  bmp(640, static_cast<std::uint32_t>(-480)), tiff({{256, 640}, {257, 480}}),
                                  std::string("P6\n# a comment\n640 480\n255\n"), std::string("P4 640 480\n")}) {
    const auto header = parseImageHeader(file);
    ASSERT_TRUE(header) << file.substr(0, 4);
    EXPECT_EQ(header->width, 640U) << file.substr(0, 4);
    EXPECT_EQ(header->height, 480U) << file.substr(0, 4);
    EXPECT_GE(header->bytes, 3U * 640 * 480) << file.substr(0, 4);
    EXPECT_LE(header->bytes, 9U * 640 * 480) << file.substr(0, 4);
    EXPECT_EQ(imageFault(file), "") << file.substr(0, 4);
  }
  EXPECT_EQ(parseImageHeader(png(640, 480, 16))->bytes, 2 * parseImageHeader(png(640, 480))->bytes);
}

TEST(ImageHeader, ImagesThatDoNotFitIntoMemoryAreRefused) {
  for (const std::string& file : {png(30000, 30000), jpeg(65000, 65000), bmp(100000, 100000),
                                  tiff({{256, 8}, {257, 8}, {322, 60000}, {323, 60000}}),
                                  std::string("P5 4000000000 4000000000 255\n"), png(0xffffffff, 0xffffffff)})
    EXPECT_NE(imageFault(file).find("memory_mb = 4000"), std::string::npos) << imageFault(file);
  const LimitedMemory limit(std::size_t{200} << 20U);
  EXPECT_EQ(imageFault(png(1280, 960)), "");
  EXPECT_NE(imageFault(png(4000, 3000)), "");
}

TEST(ImageHeader, OtherFormatsAndCutHeadersAreRefused) {
  EXPECT_NE(imageFault("GIF89a"), "");
  EXPECT_NE(imageFault(""), "");
  EXPECT_NE(imageFault(png(0, 480)), "") << "no pixels";
  for (const std::string& file :
       {png(640, 480).substr(0, 24), jpeg(640, 480), bmp(640, 480).substr(0, 25), tiff({{256, 640}, {257, 480}})})
    for (std::size_t size = 0; size + 12 < file.size() && size < 19; ++size)
      EXPECT_FALSE(parseImageHeader(file.substr(0, size))) << size;
}

TEST(ImageHeader, DamagedFiles) {
  const auto read = [](const std::string& text) { imageFault(text); };
  const std::vector<std::string> seeds = {png(64, 48), jpeg(64, 48), bmp(64, 48), tiff({{256, 64}, {257, 48}}),
                                          "P6\n#c\n64 48\n255\n"};
  EXPECT_EQ(testing::fuzzText(seeds, read).failure, "");
}

}  // namespace
}  // namespace urban_nav_core
