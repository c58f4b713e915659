// SPDX-License-Identifier: BSD-3-Clause
// Inputs that are no recordings, and recordings that are strange in one point: each is refused or read with a reason.
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <std_msgs/Int32.h>
#include <std_msgs/String.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <memory>

#include "recording/storage/byte_writer.hpp"
#include "recording/storage/mcap_records.hpp"
#include "storage/recording_samples.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/recording/mcap_writer.hpp"
#include "urban_nav_input/recording/recording.hpp"
#include "urban_nav_input/recording/recording_writer.hpp"
#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav_input {
namespace {

namespace fs = std::filesystem;
using testing::TemporaryFolder;

/// Returns the text of the error that a path raises; empty if it is read.
std::string errorOf(const std::string& path) {
  try {
    Recording recording(path);
    return "";
  } catch (const urban_nav_core::UserError& error) {
    return error.what();
  }
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Returns a std_msgs/String in little-endian CDR.
std::string cdrString(const std::string& text) {
  ByteWriter bytes;
  bytes.bytes(std::string("\0\1\0\0", 4)).text(text + std::string(1, '\0'));
  return bytes.str();
}

/// Writes one message per channel, in their order.
void writeMcap(const std::string& path, const std::vector<std::pair<McapChannel, std::string>>& messages) {
  McapWriter writer(path);
  urban_nav_core::StampNs receipt = 1000;
  for (const auto& [channel, message] : messages) {
    const std::uint16_t number = writer.addChannel(channel);
    writer.write(number, receipt++, {reinterpret_cast<const std::uint8_t*>(message.data()), message.size()});
  }
  writer.commit();
}

TEST(BadRecordings, FilesThatAreNoRecordingsAreNamedForWhatTheyAre) {
  const TemporaryFolder folder;
  const std::string pointer = "version https://git-lfs.github.com/spec/v1\noid sha256:00\nsize 12880\n";
  for (const char* ending : {".bag", ".mcap", ".db3"}) {
    const std::string path = folder.file(std::string("a") + ending);
    EXPECT_TRUE(contains(errorOf(path), "does not exist")) << errorOf(path);
    testing::writeFile(path, "");
    EXPECT_TRUE(contains(errorOf(path), "is empty")) << errorOf(path);
    testing::writeFile(path, pointer);
    EXPECT_TRUE(contains(errorOf(path), "git lfs pull")) << errorOf(path);
    testing::writeFile(path, "hello, this is text\n");
    EXPECT_TRUE(contains(errorOf(path), "is not a recording: expected a ROS 1 bag, MCAP")) << errorOf(path);
    EXPECT_TRUE(contains(errorOf(path), path)) << errorOf(path);
  }
  fs::create_directory(folder.file("empty"));
  EXPECT_TRUE(contains(errorOf(folder.file("empty")), "without a recording")) << errorOf(folder.file("empty"));
}

TEST(BadRecordings, ASocketIsNotOpened) {
  const TemporaryFolder folder;
  const std::string path = folder.file("live.mcap");
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  ASSERT_LT(path.size(), sizeof(address.sun_path));
  std::strcpy(address.sun_path, path.c_str());
  const int socket_number = socket(AF_UNIX, SOCK_STREAM, 0);
  ASSERT_EQ(bind(socket_number, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
  EXPECT_TRUE(contains(errorOf(path), "neither a file nor a folder")) << errorOf(path);
  close(socket_number);
}

TEST(BadRecordings, SchemasWithoutDefinitionAndChannelsWithoutSchemaAreUndecodedUnlessTheTypeIsKnown) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.mcap");
  writeMcap(path, {{{"/known", "std_msgs/msg/String", "ros2msg", "", "cdr", {}}, cdrString("one")},
                   {{"/unknown", "their_msgs/msg/Thing", "ros2msg", "", "cdr", {}}, cdrString("two")},
                   {{"/nothing", "", "", "", "cdr", {}}, cdrString("three")},
                   {{"/other", "std_msgs/msg/String", "protobuf", "x", "protobuf", {}}, "four"}});
  Recording recording(path);
  EXPECT_EQ(recording.undecoded("/known"), "");
  ASSERT_NE(recording.first<std_msgs::String>("/known"), nullptr);
  EXPECT_EQ(recording.first<std_msgs::String>("/known")->data, "one");
  EXPECT_TRUE(contains(recording.undecoded("/unknown"), "their_msgs/Thing")) << recording.undecoded("/unknown");
  EXPECT_FALSE(recording.undecoded("/nothing").empty());
  EXPECT_TRUE(contains(recording.undecoded("/other"), "protobuf")) << recording.undecoded("/other");
  EXPECT_EQ(recording.first<std_msgs::String>("/other"), nullptr);
  for (const char* topic : {"/known", "/unknown", "/nothing", "/other"}) EXPECT_EQ(recording.count(topic), 1U) << topic;
}

TEST(BadRecordings, AChannelMayNameASchemaThatIsNotThere) {
  const TemporaryFolder folder;
  ByteWriter out;
  const auto append = [&](mcap::Op op, const ByteWriter& content) {
    out.number(static_cast<std::uint8_t>(op)).number(static_cast<std::uint64_t>(content.size())).bytes(content.str());
  };
  out.bytes(std::string(mcap::kMagic));
  append(mcap::Op::Header, ByteWriter().text("").text(""));
  append(mcap::Op::Channel,
         ByteWriter().number(std::uint16_t{0}).number(std::uint16_t{7}).text("/a").text("cdr").text(""));
  ByteWriter message;
  message.number(std::uint16_t{0}).number(std::uint32_t{0}).number(std::uint64_t{5}).number(std::uint64_t{5});
  append(mcap::Op::Message, message.bytes(cdrString("text")));
  append(mcap::Op::DataEnd, ByteWriter().number(std::uint32_t{0}));
  testing::writeFile(folder.file("a.mcap"), out.str());
  Recording recording(folder.file("a.mcap"));
  EXPECT_EQ(recording.count("/a"), 1U);
  EXPECT_FALSE(recording.undecoded("/a").empty());
}

TEST(BadRecordings, MessagesOfRos1InMcapAreRead) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.mcap");
  writeMcap(path,
            {{{"/a", "std_msgs/String", "ros1msg", "string data\n", "ros1", {}}, ByteWriter().text("one").str()}});
  Recording recording(path);
  ASSERT_NE(recording.first<std_msgs::String>("/a"), nullptr);
  EXPECT_EQ(recording.first<std_msgs::String>("/a")->data, "one");
  EXPECT_EQ(recording.topicTypes().at("/a"), "std_msgs/String");
}

TEST(BadRecordings, ATopicMayHaveTwoTypes) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.mcap");
  const std::string number("\0\1\0\0\7\0\0\0", 8);
  writeMcap(path, {{{"/a", "std_msgs/msg/String", "ros2msg", "string data\n", "cdr", {}}, cdrString("one")},
                   {{"/a", "std_msgs/msg/Int32", "ros2msg", "int32 data\n", "cdr", {}}, number}});
  Recording recording(path);
  EXPECT_EQ(recording.count("/a"), 2U);
  ASSERT_NE(recording.first<std_msgs::String>("/a"), nullptr);
  ASSERT_NE(recording.first<std_msgs::Int32>("/a"), nullptr);
  EXPECT_EQ(recording.first<std_msgs::Int32>("/a")->data, 7);
  for (const char* type : {"std_msgs/String", "std_msgs/Int32"}) EXPECT_EQ(recording.undecoded("/a", type), "");
}

TEST(BadRecordings, AFileOfTextIsNoMetadata) {
  const TemporaryFolder folder;
  fs::create_directory(folder.file("drive"));
  testing::writeFile(folder.file("drive/metadata.yaml"), "rosbag2_bagfile_information: [\n");
  EXPECT_TRUE(contains(errorOf(folder.file("drive")), "metadata.yaml")) << errorOf(folder.file("drive"));
}

/// A .db3 that other programs change.
class BadDb3 : public ::testing::Test {
 protected:
  void SetUp() override {
    testing::writeSampleBag(folder_.file("a.bag"));
    Recording recording(folder_.file("a.bag"));
    const std::unique_ptr<RecordingWriter> writer = createRecording(folder_.file("a.mcap"));
    MessageSelection selection = recording.select(std::nullopt);
    while (const std::optional<RecordedMessage> message = selection.next())
      writer->write(message->connection(), message->receipt(), message->bytes());
    writer->commit();
    testing::writeDb3(folder_.file("a.mcap"), path(), 4);
    whole_ = testing::readContents(path());
    ASSERT_EQ(whole_.at("/imu").size(), static_cast<std::size_t>(testing::kSamples));
    sqlite3* opened = nullptr;
    ASSERT_EQ(sqlite3_open(path().c_str(), &opened), SQLITE_OK);
    other_.reset(opened);
  }

  std::string path() const { return folder_.file("a.db3"); }
  void run(const std::string& sql) {
    ASSERT_EQ(sqlite3_exec(other_.get(), sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK)
        << sqlite3_errmsg(other_.get());
  }

  TemporaryFolder folder_;
  testing::Contents whole_;
  std::unique_ptr<sqlite3, int (*)(sqlite3*)> other_{nullptr, sqlite3_close};
};

TEST_F(BadDb3, IsReadWhileAnotherProgramHasLockedIt) {
  run("BEGIN EXCLUSIVE");
  EXPECT_EQ(testing::readContents(path()), whole_);
  run("ROLLBACK");
}

TEST_F(BadDb3, NeedsNoIndex) {
  run("CREATE INDEX timestamp_idx ON messages (timestamp ASC)");
  EXPECT_EQ(testing::readContents(path()), whole_);
  run("DROP INDEX timestamp_idx");
  EXPECT_EQ(testing::readContents(path()), whole_);
  EXPECT_EQ(Recording(path()).warnings(), std::vector<std::string>());
}

TEST_F(BadDb3, OfANewerSchemaIsReadWithAWarning) {
  run("UPDATE schema SET schema_version = 9");
  run("ALTER TABLE messages ADD COLUMN checksum INTEGER");
  EXPECT_EQ(testing::readContents(path()), whole_);
  const std::vector<std::string> warnings = Recording(path()).warnings();
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_TRUE(contains(warnings[0], "schema 9")) << warnings[0];
}

TEST_F(BadDb3, OfAnotherSchemaIsNamed) {
  run("ALTER TABLE messages RENAME COLUMN data TO payload");
  try {
    testing::readContents(path());
    FAIL() << "is read";
  } catch (const urban_nav_core::Error& error) {
    EXPECT_TRUE(contains(error.what(), "a.db3")) << error.what();
    EXPECT_TRUE(contains(error.what(), "data")) << error.what();
  }
}

TEST_F(BadDb3, WithoutMessagesHasTopicsOfNone) {
  run("DELETE FROM messages");
  Recording recording(path());
  EXPECT_EQ(recording.count("/imu"), 0U);
  EXPECT_EQ(recording.topicTypes().at("/imu"), "sensor_msgs/Imu");
}

TEST_F(BadDb3, MessagesOfNoTopicAreCounted) {
  run("DELETE FROM topics WHERE name = '/imu'");
  testing::Contents rest = whole_;
  rest.erase("/imu");
  EXPECT_EQ(testing::readContents(path()), rest);
  const std::vector<std::string> warnings = Recording(path()).warnings();
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_TRUE(contains(warnings[0], std::to_string(testing::kSamples) + " messages belong to no topic")) << warnings[0];
}

TEST_F(BadDb3, MessagesThatAreStillInTheWalAreRead) {
  run("PRAGMA journal_mode = WAL");
  run("PRAGMA wal_autocheckpoint = 0");
  run("INSERT INTO messages(topic_id, timestamp, data) SELECT topic_id, timestamp + 1, data FROM messages WHERE id = "
      "2");
  ASSERT_TRUE(fs::exists(path() + "-wal"));
  std::size_t before = 0, after = 0;
  for (const auto& [topic, messages] : whole_) before += messages.size();
  for (const auto& [topic, messages] : testing::readContents(path())) after += messages.size();
  EXPECT_EQ(after, before + 1);
}

}  // namespace
}  // namespace urban_nav_input
