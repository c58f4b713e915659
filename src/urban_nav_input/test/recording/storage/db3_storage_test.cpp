// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <zstd.h>

#include <algorithm>
#include <filesystem>

#include "recording_samples.hpp"
#include "urban_nav_core/testing/fuzz.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/recording/recording.hpp"
#include "urban_nav_input/recording/recording_writer.hpp"
#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav_input {
namespace {

namespace fs = std::filesystem;
using testing::Contents;
using testing::TemporaryFolder;

class Db3Storage : public ::testing::Test {
 protected:
  void SetUp() override {
    testing::writeSampleBag(folder_.file("a.bag"));
    Recording recording(folder_.file("a.bag"));
    const std::unique_ptr<RecordingWriter> writer = createRecording(folder_.file("a.mcap"));
    MessageSelection selection = recording.select(std::nullopt);
    while (const std::optional<RecordedMessage> message = selection.next())
      writer->write(message->connection(), message->receipt(), message->bytes());
    writer->commit();
    bag_ = testing::readContents(folder_.file("a.bag"));
    fs::create_directory(folder_.file("drive"));
  }

  void writeMetadata(const std::string& files, const std::string& more = "") {
    testing::writeFile(folder_.file("drive/metadata.yaml"),
                       "rosbag2_bagfile_information:\n  version: 5\n" + more + "  relative_file_paths:\n" + files);
  }

  TemporaryFolder folder_;
  Contents bag_;
};

TEST_F(Db3Storage, HoldsTheMessagesOfTheBagWithAndWithoutDefinitions) {
  for (const int schema : {3, 4}) {
    const std::string path = folder_.file("a" + std::to_string(schema));
    testing::writeDb3(folder_.file("a.mcap"), path, schema);
    EXPECT_EQ(Recording(path).kind(), "db3") << "whatever its name";
    EXPECT_EQ(testing::readContents(path), bag_) << schema;
  }
}

TEST_F(Db3Storage, NothingIsWrittenNextToIt) {
  testing::writeDb3(folder_.file("a.mcap"), folder_.file("drive/a.db3"), 4);
  const std::string bytes = testing::readFile(folder_.file("drive/a.db3"));
  for (const bool has_wal : {false, true}) {
    if (has_wal) testing::writeFile(folder_.file("drive/a.db3-wal"), std::string(5000, 'x'));
    EXPECT_EQ(testing::readContents(folder_.file("drive/a.db3")), bag_) << "a stale -wal: " << has_wal;
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_.file("drive")), fs::directory_iterator()), has_wal ? 2 : 1);
    EXPECT_EQ(testing::readFile(folder_.file("drive/a.db3")), bytes);
  }
  EXPECT_EQ(testing::readFile(folder_.file("drive/a.db3-wal")), std::string(5000, 'x'));
}

TEST_F(Db3Storage, AFolderIsItsFiles) {
  testing::writeDb3(folder_.file("a.mcap"), folder_.file("drive/a_0.db3"), 3, true);
  writeMetadata("    - a_0.db3\n", "  compression_format: zstd\n  compression_mode: MESSAGE\n");
  EXPECT_EQ(Recording(folder_.file("drive")).kind(), "rosbag2");
  EXPECT_EQ(testing::readContents(folder_.file("drive")), bag_);
  writeMetadata("    - drive/a_0.db3\n    - a_1.db3\n");
  EXPECT_EQ(testing::readContents(folder_.file("drive")), bag_) << "Eloquent names the folder too";
  const std::vector<std::string> warnings = Recording(folder_.file("drive")).warnings();
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("a_1.db3"), std::string::npos);
  fs::remove(folder_.file("drive/metadata.yaml"));
  EXPECT_EQ(testing::readContents(folder_.file("drive")), bag_) << "the only one in the folder";
  fs::copy(folder_.file("a.mcap"), folder_.file("drive/b"));
  EXPECT_THROW(Recording(folder_.file("drive")), urban_nav_core::UserError) << "which of the two?";
}

TEST_F(Db3Storage, AFileOfAFolderThatIsNoRecordingIsNamed) {
  testing::writeDb3(folder_.file("a.mcap"), folder_.file("drive/a_0.db3"), 4);
  testing::writeFile(folder_.file("drive/a_1.db3"), "");  // as a loss of power leaves it
  writeMetadata("    - a_0.db3\n    - a_1.db3\n");
  EXPECT_EQ(testing::readContents(folder_.file("drive")), bag_);
  const std::vector<std::string> warnings = Recording(folder_.file("drive")).warnings();
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("a_1.db3"), std::string::npos) << warnings[0];
  testing::writeFile(folder_.file("drive/a_0.db3"), "");
  EXPECT_THROW(Recording(folder_.file("drive")), urban_nav_core::Error);
}

TEST_F(Db3Storage, WholeMessagesUpToACutAreUsed) {
  testing::writeDb3(folder_.file("a.mcap"), folder_.file("a.db3"), 4);
  const std::string bytes = testing::readFile(folder_.file("a.db3"));
  std::size_t most = 0;
  for (std::size_t size = bytes.size() / 2; size < bytes.size(); size += bytes.size() / 8) {
    const std::string path = folder_.file("b.db3");
    testing::writeFile(path, bytes.substr(0, size));
    try {
      std::size_t count = 0;
      for (const auto& [topic, messages] : testing::readContents(path)) count += messages.size();
      most = std::max(most, count);
      const std::vector<std::string> warnings = Recording(path).warnings();
      ASSERT_FALSE(warnings.empty()) << size;
      EXPECT_NE(warnings[0].find("cut off at byte " + std::to_string(size)), std::string::npos) << warnings[0];
    } catch (const urban_nav_core::DataError& error) {
      EXPECT_NE(std::string(error.what()).find("b.db3"), std::string::npos) << error.what();
    }
  }
  EXPECT_GT(most, static_cast<std::size_t>(testing::kSamples));
}

TEST_F(Db3Storage, FilesMayBeCompressed) {
  const std::string plain = testing::readFile(folder_.file("a.mcap"));
  std::string packed;
  for (const std::string& half : {plain.substr(0, plain.size() / 2), plain.substr(plain.size() / 2)}) {
    std::string frame(ZSTD_compressBound(half.size()), '\0');
    frame.resize(ZSTD_compress(frame.data(), frame.size(), half.data(), half.size(), 1));
    packed += frame;
  }
  testing::writeFile(folder_.file("drive/a_0.mcap.zstd"), packed);
  writeMetadata("    - a_0.mcap.zstd\n", "  compression_format: zstd\n  compression_mode: FILE\n");
  EXPECT_EQ(testing::readContents(folder_.file("drive")), bag_);
  EXPECT_EQ(testing::readContents(folder_.file("drive/a_0.mcap.zstd")), bag_);
  testing::writeFile(folder_.file("drive/a_0.mcap.zstd"), packed.substr(0, packed.size() - 20));
  EXPECT_FALSE(Recording(folder_.file("drive")).warnings().empty());
}

TEST_F(Db3Storage, MetadataNameTheEncodingOfMessages) {
  testing::writeDb3(folder_.file("a.mcap"), folder_.file("drive/a_0.db3"), 4);
  writeMetadata("    - a_0.db3\n",
                "  topics_with_message_count:\n    - topic_metadata:\n        name: /imu\n"
                "        serialization_format: other\n");
  const Contents some = testing::readContents(folder_.file("drive"));
  EXPECT_EQ(some.count("/imu"), 0U);
  EXPECT_EQ(some.at("/text"), bag_.at("/text"));
  EXPECT_EQ(Recording(folder_.file("drive")).count("/imu"), static_cast<std::size_t>(testing::kSamples));
}

TEST_F(Db3Storage, DamagedFilesAreRefusedOrCounted) {
  testing::writeDb3(folder_.file("a.mcap"), folder_.file("a.db3"), 4);
  testing::writeDb3(folder_.file("a.mcap"), folder_.file("b.db3"), 3, true);
  const auto read = [](const std::string& path) {
    try {
      testing::readContents(path);
    } catch (const urban_nav_core::DataError&) {
      return;
    }
  };
  const auto result = urban_nav_core::testing::fuzzFile(
      {testing::readFile(folder_.file("a.db3")), testing::readFile(folder_.file("b.db3"))}, "a.db3", read);
  EXPECT_EQ(result.failure.substr(0, 200), "");
}

}  // namespace
}  // namespace urban_nav_input
