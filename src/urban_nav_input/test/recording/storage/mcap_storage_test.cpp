// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <sensor_msgs/Imu.h>

#include <algorithm>
#include <utility>

#include "recording/storage/mcap_records.hpp"
#include "recording/storage/storage.hpp"
#include "recording_samples.hpp"
#include "urban_nav_core/testing/fuzz.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/recording/mcap_writer.hpp"
#include "urban_nav_input/recording/recording.hpp"
#include "urban_nav_input/recording/recording_writer.hpp"
#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav_input {
namespace {

using testing::Contents;
using testing::kSamples;
using testing::McapForm;
using testing::TemporaryFolder;

class McapStorage : public ::testing::Test {
 protected:
  void SetUp() override {
    testing::writeSampleBag(folder_.file("a.bag"));
    convert("a.bag", "a.mcap");
    written_ = testing::readFile(folder_.file("a.mcap"));
  }

  void convert(const std::string& from, const std::string& to) {
    Recording recording(folder_.file(from));
    const std::unique_ptr<RecordingWriter> writer = createRecording(folder_.file(to));
    MessageSelection selection = recording.select(std::nullopt);
    while (const std::optional<RecordedMessage> message = selection.next())
      writer->write(message->connection(), message->receipt(), message->bytes());
    writer->commit();
  }
  std::string write(const std::string& bytes) {
    testing::writeFile(folder_.file("b.mcap"), bytes);
    return folder_.file("b.mcap");
  }

  TemporaryFolder folder_;
  std::string written_;
};

std::size_t countMessages(const Contents& contents) {
  std::size_t count = 0;
  for (const auto& [topic, messages] : contents) count += messages.size();
  return count;
}

TEST_F(McapStorage, HoldsTheMessagesOfTheBagInEveryForm) {
  const Contents bag = testing::readContents(folder_.file("a.bag"));
  ASSERT_EQ(countMessages(bag), 3U * kSamples + 1U);
  EXPECT_EQ(testing::readContents(folder_.file("a.mcap")), bag);
  for (const char* compression : {"", "lz4", "zstd"})
    for (const bool has_indexes : {true, false})
      for (const bool has_summary : {true, false}) {
        const McapForm form{compression, true, has_indexes, has_summary};
        const std::string path = write(testing::rewriteMcap(written_, form));
        EXPECT_EQ(testing::readContents(path), bag) << compression << has_indexes << has_summary;
        EXPECT_EQ(Recording(path).warnings().empty(), has_summary);
      }
  EXPECT_EQ(testing::readContents(write(testing::rewriteMcap(written_, {"", false, false, true}))), bag);
  convert("a.mcap", "back.bag");
  EXPECT_EQ(testing::readContents(folder_.file("back.bag")), bag);
}

TEST_F(McapStorage, TypesHaveTheNamesOfRos1AndMd5SumsOfTheDefinition) {
  Recording recording(folder_.file("a.mcap"));
  EXPECT_EQ(recording.kind(), "mcap");
  EXPECT_EQ(recording.topicTypes().at("/imu"), "sensor_msgs/Imu");
  EXPECT_EQ(recording.count("/imu"), static_cast<std::size_t>(kSamples));
}

TEST_F(McapStorage, WholeMessagesUpToACutAreUsed) {
  const Contents whole = testing::readContents(folder_.file("a.bag"));
  for (const McapForm& form : {McapForm{"", false, false, true}, McapForm{"", true, true, true},
                               McapForm{"lz4", true, true, true}, McapForm{"zstd", true, true, true}}) {
    const std::string bytes = testing::rewriteMcap(written_, form);
    std::size_t before = 0;
    for (std::size_t size = bytes.size() / 10; size < bytes.size() - 30; size += bytes.size() / 13) {
      const std::string path = write(bytes.substr(0, size));
      const Contents some = testing::readContents(path);
      for (const auto& [topic, messages] : some)
        for (std::size_t i = 0; i < messages.size(); ++i) ASSERT_EQ(messages[i], whole.at(topic)[i]) << topic;
      EXPECT_GE(countMessages(some), before) << size;
      before = countMessages(some);
      const std::vector<std::string> warnings = Recording(path).warnings();
      ASSERT_EQ(warnings.size(), 1U);
      EXPECT_NE(warnings[0].find("cut off"), std::string::npos) << warnings[0];
      EXPECT_NE(warnings[0].find(std::to_string(before)), std::string::npos) << warnings[0];
    }
    EXPECT_GT(before, static_cast<std::size_t>(kSamples)) << form.compression;
  }
}

TEST_F(McapStorage, ChunksOfOtherTopicsAreNotDecompressed) {
  constexpr int kImages = 40, kImageBytes = 200'000, kSmall = 1000;
  McapWriter writer(folder_.file("apart.mcap"));
  const std::uint16_t images = writer.addChannel({"/image", "test_msgs/msg/A", "ros2msg", "string data\n", "cdr", {}});
  const std::uint16_t imu = writer.addChannel({"/imu", "test_msgs/msg/A", "ros2msg", "string data\n", "cdr", {}});
  const std::vector<std::uint8_t> image(kImageBytes, 7), small(300, 8);
  for (int i = 0; i < kImages; ++i) writer.write(images, i, {image.data(), image.size()});
  for (int i = 0; i < kSmall; ++i) writer.write(imu, i, {small.data(), small.size()});
  writer.commit();
  const std::unique_ptr<Storage> storage = openMcapStorage(folder_.file("apart.mcap"));
  const auto readAll = [&](const std::string& topic) {
    std::size_t read = 0;
    for (std::size_t i = 0; i < storage->connections().size(); ++i) {
      if (storage->connections()[i].topic != topic) continue;
      for (const MessageEntry& entry : storage->index(i)) read += storage->read(i, entry).size > 0 ? 1 : 0;
    }
    return read;
  };
  EXPECT_EQ(readAll("/imu"), static_cast<std::size_t>(kSmall));
  const std::uint64_t for_imu = storage->chunksInflated();
  EXPECT_GE(for_imu, 1U);
  EXPECT_LE(for_imu, 2U) << "those of the small topic, the first of which may hold an image too";
  EXPECT_EQ(readAll("/image"), static_cast<std::size_t>(kImages));
  EXPECT_GT(storage->chunksInflated(), for_imu + 1);
}

TEST_F(McapStorage, EachChunkIsDecompressedOnceInOrderOfReceipt) {
  constexpr int kMessages = 200;
  McapWriter writer(folder_.file("long.mcap"));
  const std::vector<std::uint8_t> message(200'000, 7);
  std::vector<std::uint16_t> channels;
  for (const char* topic : {"/a", "/b"})
    channels.push_back(writer.addChannel({topic, "test_msgs/msg/A", "ros2msg", "string data\n", "cdr", {}}));
  for (int i = 0; i < kMessages; ++i)
    writer.write(channels[static_cast<std::size_t>(i) % 2], i / 3, {message.data(), message.size()});
  writer.commit();
  const std::unique_ptr<Storage> storage = openMcapStorage(folder_.file("long.mcap"));
  std::vector<std::pair<MessageEntry, std::size_t>> all;
  for (std::size_t topic = 0; topic < 2; ++topic)
    for (const MessageEntry& entry : storage->index(topic)) all.emplace_back(entry, topic);
  std::sort(all.begin(), all.end());
  ASSERT_EQ(all.size(), static_cast<std::size_t>(kMessages));
  for (const auto& [entry, topic] : all) EXPECT_EQ(storage->read(topic, entry).size, message.size());
  const std::size_t chunks = testing::countChunks(testing::readFile(folder_.file("long.mcap")));
  EXPECT_GT(chunks, 20U);
  EXPECT_EQ(storage->chunksInflated(), chunks);
  EXPECT_EQ(storage->read(all.front().second, all.front().first).size, message.size()) << "back to the first chunk";
}

TEST_F(McapStorage, AChunkWithAWrongChecksumIsNamedAndLeftOut) {
  for (const bool has_summary : {true, false}) {
    std::string bytes = testing::rewriteMcap(written_, {"", true, true, has_summary});
    bytes[bytes.find("message 7")] = 'M';
    Recording recording(write(bytes));
    RecordedMessages messages = recording.messages({"/imu"});
    while (const auto message = messages.next()) EXPECT_FALSE(message->as<sensor_msgs::Imu>());
    ASSERT_FALSE(recording.warnings().empty());
    EXPECT_NE(recording.warnings()[0].find("checksum"), std::string::npos) << recording.warnings()[0];
  }
}

TEST_F(McapStorage, AnUnknownCompressionIsNamed) {
  std::string bytes = written_;
  for (std::size_t at = 0; (at = bytes.find("zstd", at)) != std::string::npos;) bytes.replace(at, 4, "zpaq");
  try {
    Recording recording(write(bytes));
    FAIL() << "is read";
  } catch (const urban_nav_core::UserError& error) {
    EXPECT_NE(std::string(error.what()).find("zpaq"), std::string::npos) << error.what();
  }
}

TEST_F(McapStorage, DamagedFilesAreRefusedOrCounted) {
  std::vector<std::string> seeds;
  for (const McapForm& form : {McapForm{"", false, false, true}, McapForm{"", true, true, true},
                               McapForm{"lz4", true, false, true}, McapForm{"zstd", true, true, false}})
    seeds.push_back(testing::rewriteMcap(written_, form));
  const auto read = [](const std::string& path) {
    try {
      testing::readContents(path);
    } catch (const urban_nav_core::DataError&) {
      return;
    }
  };
  EXPECT_EQ(urban_nav_core::testing::fuzzFile(seeds, "a.mcap", read).failure.substr(0, 200), "");
}

}  // namespace
}  // namespace urban_nav_input
