// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <cstdio>

#include "recording_samples.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/recording/recording.hpp"
#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav_input {
namespace {

using rosbag::compression::CompressionType;
using testing::Contents;
using testing::kSamples;
using testing::readFile;
using testing::writeFile;

constexpr std::uint32_t kChunkThreshold = 4000;  // bytes, so that the samples fill several chunks

class BagStorage : public ::testing::Test {
 protected:
  void SetUp() override {
    testing::writeSampleBag(folder_.file("a.bag"));
    whole_ = testing::readContents(folder_.file("a.bag"));
  }

  /// Returns the bytes of the samples as a bag: whole, or as a recorder leaves it that is killed.
  std::string record(CompressionType compression, bool is_closed) {
    rosbag::Bag from(folder_.file("a.bag")), to(folder_.file("b.bag"), rosbag::bagmode::Write);
    to.setCompression(compression);
    to.setChunkThreshold(kChunkThreshold);
    for (const rosbag::MessageInstance& message : rosbag::View(from))
      to.write(message.getTopic(), message.getTime(), message, message.getConnectionHeader());
    if (is_closed) to.close();
    std::fflush(nullptr);
    return readFile(folder_.file("b.bag"));
  }
  std::string put(const std::string& bytes) {
    writeFile(folder_.file("c.bag.active"), bytes);
    return folder_.file("c.bag.active");
  }
  /// Returns the number of messages, and expects each topic to hold the first of its messages.
  std::size_t countFirst(const Contents& some) {
    std::size_t count = 0;
    for (const auto& [topic, messages] : some) {
      for (std::size_t i = 0; i < messages.size(); ++i) EXPECT_EQ(messages[i], whole_.at(topic)[i]) << topic;
      count += messages.size();
    }
    return count;
  }

  testing::TemporaryFolder folder_;
  Contents whole_;
};

constexpr CompressionType kCompressions[] = {rosbag::compression::Uncompressed, rosbag::compression::BZ2,
                                             rosbag::compression::LZ4};

TEST_F(BagStorage, WholeMessagesUpToACutAreUsed) {
  for (const CompressionType compression : kCompressions) {
    const std::string bytes = record(compression, true);
    std::size_t before = 0;
    for (std::size_t size = 3 * bytes.size() / 10; size < bytes.size() - 10; size += bytes.size() / 13) {
      const std::string path = put(bytes.substr(0, size));
      const std::size_t count = countFirst(testing::readContents(path));
      EXPECT_GE(count, before) << size;
      before = count;
      const std::vector<std::string> warnings = Recording(path).warnings();
      ASSERT_EQ(warnings.size(), 1U);
      EXPECT_NE(warnings[0].find("cut off"), std::string::npos) << warnings[0];
      EXPECT_NE(warnings[0].find("the " + std::to_string(count) + " "), std::string::npos) << warnings[0];
    }
    EXPECT_GT(before, static_cast<std::size_t>(kSamples)) << compression;
  }
}

TEST_F(BagStorage, ABagThatItsRecorderDidNotCloseIsRead) {
  for (const CompressionType compression : kCompressions) {
    const std::string path = put(record(compression, false));
    Recording recording(path);
    EXPECT_EQ(recording.kind(), "bag");
    ASSERT_EQ(recording.warnings().size(), 1U);
    EXPECT_NE(recording.warnings()[0].find("not closed"), std::string::npos) << recording.warnings()[0];
    const Contents some = testing::readContents(path);
    const std::size_t count = countFirst(some);
    if (compression == rosbag::compression::Uncompressed) {
      EXPECT_EQ(some, whole_);
    } else {
      EXPECT_GT(count, static_cast<std::size_t>(kSamples)) << "the chunk at work is lost";
    }
  }
}

TEST_F(BagStorage, AnIndexThatIsGoneIsNotNeeded) {
  const std::string bytes = record(rosbag::compression::Uncompressed, true);
  std::string damaged = bytes;
  const std::size_t index = damaged.rfind("chunk_pos=");  // in the index at the end
  ASSERT_NE(index, std::string::npos);
  damaged.replace(index, 10, "chunk_pos!");
  EXPECT_EQ(testing::readContents(put(damaged)), whole_);
  EXPECT_EQ(Recording(put(damaged)).warnings().size(), 1U);
  EXPECT_TRUE(Recording(put(bytes)).warnings().empty());
}

TEST_F(BagStorage, MessagesOfADamagedChunkAreLeftOutAndCounted) {
  std::string bytes = record(rosbag::compression::BZ2, true);
  const std::size_t chunk = bytes.find("BZh", bytes.find("BZh") + 1);  // the second
  ASSERT_NE(chunk, std::string::npos);
  bytes.replace(chunk + 20, 8, 8, '\x55');
  Recording recording(put(bytes));
  MessageSelection messages = recording.select(std::nullopt);
  std::size_t read = 0, lost = 0;
  while (const std::optional<RecordedMessage> message = messages.next())
    ++(message->bytes().data == nullptr ? lost : read);
  EXPECT_GT(lost, 0U);
  EXPECT_GT(read, lost);
  ASSERT_EQ(recording.warnings().size(), 1U);
  EXPECT_NE(recording.warnings()[0].find(": " + std::to_string(lost) + " message"), std::string::npos)
      << recording.warnings()[0];
}

TEST_F(BagStorage, ABagWithoutAWholeMessageIsRefused) {
  const std::string bytes = record(rosbag::compression::Uncompressed, true);
  for (const std::size_t size : {std::size_t{13}, std::size_t{2000}, std::size_t{4200}})
    EXPECT_THROW(Recording(put(bytes.substr(0, size))), urban_nav_core::DataError) << size;
}

}  // namespace
}  // namespace urban_nav_input
