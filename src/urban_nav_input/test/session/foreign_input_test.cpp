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

TEST(ForeignInput, BagsOfRos2NameTheCommandThatConvertsThem) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.file("drive"));
  writeBytes(folder.file("drive/drive_0.db3"), std::string("SQLite format 3\0", 16) + "more");
  writeBytes(folder.file("drive/metadata.yaml"), "rosbag2_bagfile_information:\n");
  writeBytes(folder.file("other.mcap"), std::string("\x89MCAP0\r\n", 8) + "more");
  for (const char* name : {"drive", "drive/drive_0.db3", "other.mcap"}) {
    const std::string text = refusal(folder.file(name));
    EXPECT_NE(text.find("ROS 2 bag"), std::string::npos) << text;
    EXPECT_NE(text.find("rosbags-convert --src " + folder.file(name)), std::string::npos) << text;
  }
}

TEST(ForeignInput, StoresCompressedBagsAndFoldersOfBagsAreNamed) {
  const TemporaryFolder folder;
  writeBytes(folder.file("session.db"), std::string("SQLite format 3\0", 16));
  EXPECT_NE(refusal(folder.file("session.db")).find("--store"), std::string::npos);
  writeBytes(folder.file("a.bag.gz"), "\x1f\x8b\x08 and so on");
  EXPECT_NE(refusal(folder.file("a.bag.gz")).find("gzip -d"), std::string::npos);
  std::filesystem::create_directory(folder.file("bags"));
  writeBytes(folder.file("bags/one.bag"), "#ROSBAG V2.0\n");
  EXPECT_NE(refusal(folder.file("bags")).find("one.bag"), std::string::npos);
}

TEST(ForeignInput, AnEmptyOrUnknownFileIsNotMisnamed) {
  const TemporaryFolder folder;
  writeBytes(folder.file("empty"), "");
  writeBytes(folder.file("text"), "hello");
  for (const char* name : {"empty", "text"}) {
    EXPECT_FALSE(recogniseForeignInput(folder.file(name)));
    EXPECT_NE(refusal(folder.file(name)).find("is no bag"), std::string::npos);
  }
}

}  // namespace
}  // namespace urban_nav_input
