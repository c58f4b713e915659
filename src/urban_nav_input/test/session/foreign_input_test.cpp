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

TEST(ForeignInput, FilesAreNamedByTheirContent) {
  const TemporaryFolder folder;
  const std::string ros1("\x89MCAP0\r\n\x01\x10\0\0\0\0\0\0\0\x04\0\0\0ros1\x04\0\0\0test", 33);
  writeBytes(folder.file("a.bag"), "version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\n");
  writeBytes(folder.file("b.bag"), "");
  writeBytes(folder.file("c.bag"),
             std::string("SQLite format 3\0", 16) + "CREATE TABLE topics(id) CREATE TABLE messages(id)");
  writeBytes(folder.file("d.bag"), ros1);
  for (const auto& [name, words] : {std::make_pair("a.bag", "Git LFS"), std::make_pair("b.bag", "is empty"),
                                    std::make_pair("c.bag", "ROS 2 bag"), std::make_pair("d.bag", "ROS 1 messages")})
    EXPECT_NE(refusal(folder.file(name)).find(words), std::string::npos) << refusal(folder.file(name));
  EXPECT_EQ(refusal(folder.file("d.bag")).find("ROS 2"), std::string::npos);
}

TEST(ForeignInput, FoldersOfRosbag2NameTheFileThatCannotBeRead) {
  const TemporaryFolder folder;
  const std::string head = "rosbag2_bagfile_information:\n  relative_file_paths:\n    - ";
  for (const char* name : {"missing", "packed"}) std::filesystem::create_directory(folder.file(name));
  writeBytes(folder.file("missing/metadata.yaml"), head + "run_0.db3\n  compression_mode: \"\"\n");
  writeBytes(folder.file("packed/metadata.yaml"), head + "run_0.db3.zstd\n");
  writeBytes(folder.file("packed/run_0.db3.zstd"), "bytes");
  EXPECT_NE(refusal(folder.file("missing")).find("run_0.db3, which is not there"), std::string::npos);
  EXPECT_NE(refusal(folder.file("packed")).find("compressed by zstd"), std::string::npos);
}

TEST(ForeignInput, AnUnknownFileIsNotMisnamed) {
  const TemporaryFolder folder;
  writeBytes(folder.file("text"), "hello");
  EXPECT_FALSE(recogniseForeignInput(folder.file("text")));
  EXPECT_NE(refusal(folder.file("text")).find("is no bag"), std::string::npos);
}

}  // namespace
}  // namespace urban_nav_input
