// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/file_kind.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace urban_nav_core {
namespace {

TEST(FileKind, ForeignFilesAreNamedByTheirContent) {
  for (const auto& [content, words] :
       {std::make_pair("", "empty"), std::make_pair("version https://git-lfs.github.com/spec/v1\n", "Git LFS"),
        std::make_pair("10 6  0 0\n0 0 0 7 14\n", "ORB-SLAM2"),
        std::make_pair("%YAML:1.0\n---\nvocabulary:\n   k: 10\n", "DBoW3"),
        std::make_pair("%YAML:1.0\nVocabulary: !!opencv-matrix\n", "OpenCV")})
    EXPECT_NE(describeForeignContent(content).find(words), std::string::npos) << describeForeignContent(content);
  EXPECT_NE(describeForeignContent(std::string("\xFC\xCE\x53\x03\0\0\0\0", 8)).find("fbow"), std::string::npos);
  EXPECT_NE(describeForeignContent(std::string("\x81\x3F\x86\xB1\x14\0\0\0", 8)).find("DBoW3"), std::string::npos);
}

TEST(FileKind, WhatIsNotRecognisedHasNoName) {
  for (const char* content : {"hello", "1 2 3 4 5\n", "10 6 0 9\n"})
    EXPECT_EQ(describeForeignContent(content), "") << content;
}

}  // namespace
}  // namespace urban_nav_core
