// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "session/foreign_input.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/session/open.hpp"

#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav_input {
namespace {

using testing::TemporaryFolder;

void writeBytes(const std::string& path, const std::string& bytes) { std::ofstream(path, std::ios::binary) << bytes; }

/// Returns the message of the error that an input of this path raises.
std::string refusal(const std::string& path) {
  try {
    inputKind(path);
  } catch (const urban_nav_core::UserError& error) {
    return error.what();
  }
  return "";
}

TEST(ForeignInput, WhatOnlyHasTheNameOfARecordingIsNamed) {
  const TemporaryFolder folder;
  writeBytes(folder.file("empty.mcap"), "");
  writeBytes(folder.file("pointer.mcap"), "version https://git-lfs.github.com/spec/v1\noid sha256:00\nsize 12880\n");
  writeBytes(folder.file("other.db3"), std::string("SQLite format 3\0", 16) + "more");
  EXPECT_NE(refusal(folder.file("empty.mcap")).find("is empty"), std::string::npos);
  EXPECT_NE(refusal(folder.file("pointer.mcap")).find("Git LFS"), std::string::npos);
  EXPECT_NE(refusal(folder.file("other.db3")).find("topics and messages"), std::string::npos);
}

TEST(ForeignInput, StoresCompressedBagsAndFoldersOfBagsAreNamed) {
  const TemporaryFolder folder;
  std::string store("SQLite format 3\0", 16);
  store.resize(100);
  store.replace(68, 4, "unav");  // the application that the file belongs to
  writeBytes(folder.file("session.db"), store);
  EXPECT_NE(refusal(folder.file("session.db")).find("--store"), std::string::npos);
  writeBytes(folder.file("a.bag.gz"), "\x1f\x8b\x08 and so on");
  EXPECT_NE(refusal(folder.file("a.bag.gz")).find("gzip -d"), std::string::npos);
  std::filesystem::create_directory(folder.file("bags"));
  writeBytes(folder.file("bags/one.bag"), "#ROSBAG V2.0\n");
  EXPECT_NE(refusal(folder.file("bags")).find("one.bag"), std::string::npos);
}

TEST(ForeignInput, AnUnknownFileIsNotMisnamed) {
  const TemporaryFolder folder;
  writeBytes(folder.file("text"), "hello");
  EXPECT_FALSE(recogniseForeignInput(folder.file("text")));
  EXPECT_NE(refusal(folder.file("text")).find("is not a recording"), std::string::npos);
}

}  // namespace
}  // namespace urban_nav_input
