// SPDX-License-Identifier: BSD-3-Clause
// Free of ROS: compiled under the sanitizers too.
#include <gtest/gtest.h>
#include <lz4frame.h>
#include <sqlite3.h>
#include <unistd.h>
#include <zstd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "recording/message/transcoder.hpp"
#include "recording/storage/bag_records.hpp"
#include "recording/storage/byte_writer.hpp"
#include "recording/storage/inflate.hpp"
#include "recording/storage/mcap_records.hpp"
#include "recording/storage/packed_message.hpp"
#include "recording/storage/rosbag2_metadata.hpp"
#include "recording/storage/storage.hpp"
#include "recording/storage/unpacked_file.hpp"
#include "urban_nav_core/testing/fuzz.hpp"
#include "urban_nav_core/testing/limited_memory.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/recording/mcap_writer.hpp"

namespace urban_nav_input {
namespace {

namespace fs = std::filesystem;
using mcap::Op;

constexpr const char* kDefinition = "string data\nfloat64[] values\nuint8 last\n";

std::string makeMessage(int i) {
  ByteWriter message;
  const std::string text = "message " + std::to_string(i) + std::string(1, '\0');
  message.bytes(std::string("\0\1\0\0", 4)).text(text);
  while (message.size() % 4 != 0) message.number(std::uint8_t{0});
  message.number(std::uint32_t{1});
  while ((message.size() - 4) % 8 != 0) message.number(std::uint8_t{0});
  message.number(std::uint64_t{0x3ff0000000000000}).number(std::uint8_t{7});
  return message.str();
}

std::string readWhole(const std::string& path) {
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  return bytes.str();
}

std::string makeChunked() {
  const std::string path =
      (fs::temp_directory_path() / ("storage_fuzz_" + std::to_string(getpid()))).string() + ".mcap";
  McapWriter writer(path);
  const std::uint16_t channel = writer.addChannel({"/a", "test_msgs/msg/A", "ros2msg", kDefinition, "cdr", {}});
  for (int i = 0; i < 20; ++i) {
    const std::string message = makeMessage(i);
    writer.write(channel, 1000 + i, {reinterpret_cast<const std::uint8_t*>(message.data()), message.size()});
  }
  writer.commit();
  std::string bytes = readWhole(path);
  fs::remove(path);
  return bytes;
}

void append(Op op, const ByteWriter& content, ByteWriter& out) {
  out.number(static_cast<std::uint8_t>(op)).number(static_cast<std::uint64_t>(content.size())).bytes(content.str());
}

/// Returns a schema, a channel and messages.
std::string makeMcapRecords() {
  ByteWriter out, schema, channel;
  schema.number(std::uint16_t{1}).text("test_msgs/msg/A").text("ros2msg").text(kDefinition);
  append(Op::Schema, schema, out);
  channel.number(std::uint16_t{0}).number(std::uint16_t{1}).text("/a").text("cdr").text("");
  append(Op::Channel, channel, out);
  for (int i = 0; i < 20; ++i) {
    ByteWriter message;
    message.number(std::uint16_t{0}).number(std::uint32_t{0}).number(std::uint64_t{5}).number(std::uint64_t{5});
    append(Op::Message, message.bytes(makeMessage(i)), out);
  }
  return out.str();
}

std::string makeUnchunked() {
  ByteWriter out;
  out.bytes(std::string(mcap::kMagic));
  append(Op::Header, ByteWriter().text("ros2").text(""), out);
  out.bytes(makeMcapRecords());
  append(Op::DataEnd, ByteWriter().number(std::uint32_t{0}), out);
  return out.str();
}

/// An MCAP file without an index whose chunks are not compressed, or by lz4 and without checksum, and whose end is
/// missing.
std::string makeUnfinished() {
  const std::string records = makeMcapRecords();
  std::string packed(LZ4F_compressFrameBound(records.size(), nullptr), '\0');
  packed.resize(LZ4F_compressFrame(packed.data(), packed.size(), records.data(), records.size(), nullptr));
  ByteWriter out;
  out.bytes(std::string(mcap::kMagic));
  append(Op::Header, ByteWriter().text("ros2").text(""), out);
  for (const auto& [compression, bytes] : {std::pair("", records), std::pair("lz4", packed)}) {
    ByteWriter chunk;
    chunk.number(std::uint64_t{5}).number(std::uint64_t{5}).number(static_cast<std::uint64_t>(records.size()));
    chunk.number(std::uint32_t{0}).text(compression).number(static_cast<std::uint64_t>(bytes.size())).bytes(bytes);
    append(Op::Chunk, chunk, out);
  }
  return out.str();
}

std::string makeDb3() {
  const std::string path = (fs::temp_directory_path() / ("storage_fuzz_" + std::to_string(getpid()))).string() + ".db3";
  sqlite3* database = nullptr;
  sqlite3_open(path.c_str(), &database);
  std::string sql =
      "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, serialization_format TEXT, qos TEXT);"
      "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, data BLOB);"
      "CREATE TABLE schema(schema_version INTEGER PRIMARY KEY, ros_distro TEXT);"
      "CREATE TABLE message_definitions(id INTEGER PRIMARY KEY, topic_type TEXT, encoding TEXT, "
      "encoded_message_definition TEXT, type_description_hash TEXT);"
      "INSERT INTO schema VALUES(4, 'test');"
      "INSERT INTO message_definitions VALUES(1, 'test_msgs/msg/A', 'ros2msg', 'string data', '');"
      "INSERT INTO topics VALUES(1, '/a', 'test_msgs/msg/A', 'cdr', '');";
  for (int i = 0; i < 20; ++i)
    sql += "INSERT INTO messages VALUES(" + std::to_string(i + 1) + ", 1, " + std::to_string(100 + i) +
           ", x'0001000003000000686900000000000000000000')" + ";";
  sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr);
  sqlite3_close(database);
  std::string bytes = readWhole(path);
  fs::remove(path);
  return bytes;
}

std::string makeBagRecord(std::uint8_t op, const std::vector<std::pair<std::string, std::string>>& fields,
                          const std::string& data) {
  ByteWriter header, record;
  header.text("op=" + std::string(1, static_cast<char>(op)));
  for (const auto& [name, value] : fields) header.text(name + "=" + value);
  record.text(header.str()).text(data);
  return record.str();
}

std::string toBytes(std::uint32_t number) { return ByteWriter().number(number).str(); }

std::string makeBagConnection() {
  ByteWriter about;
  about.text("topic=/a")
      .text("type=test_msgs/A")
      .text("md5sum=0")
      .text("message_definition=" + std::string(kDefinition));
  return makeBagRecord(7, {{"conn", toBytes(0)}, {"topic", "/a"}}, about.str());
}

/// A connection and its messages; `index`: time and offset of each.
std::string makeBagRecords(std::string& index) {
  std::string records = makeBagConnection();
  for (std::uint32_t i = 0; i < 20; ++i) {
    index += toBytes(i) + toBytes(0) + toBytes(static_cast<std::uint32_t>(records.size()));
    records +=
        makeBagRecord(2, {{"conn", toBytes(0)}, {"time", toBytes(i) + toBytes(0)}}, makeMessage(static_cast<int>(i)));
  }
  return records;
}

/// Numbers that are wrong in the index of a bag; 0: right.
struct IndexLie {
  std::uint32_t chunk_size = 0, packed_size = 0, messages = 0, offset = 0, index_size = 0, fields_size = 0;
  std::uint32_t chunks = 1;  ///< number of times that the index names the chunk
  std::string compression = "none";
};

/// A bag that its recorder closed: one chunk with its index.
std::string makeIndexedBag(const IndexLie& lie = {}) {
  std::string index;
  const std::string records = makeBagRecords(index);
  const auto orElse = [](std::uint32_t lied, std::size_t truth) {
    return toBytes(lied != 0 ? lied : static_cast<std::uint32_t>(truth));
  };
  if (lie.offset != 0) index.replace(8, 4, toBytes(lie.offset));
  std::string chunk =
      makeBagRecord(5, {{"compression", lie.compression}, {"size", orElse(lie.chunk_size, records.size())}}, records);
  if (lie.packed_size != 0) chunk.replace(chunk.size() - records.size() - 4, 4, toBytes(lie.packed_size));
  std::string places =
      makeBagRecord(4, {{"ver", toBytes(1)}, {"conn", toBytes(0)}, {"count", orElse(lie.messages, 20)}}, index);
  if (lie.index_size != 0) places.replace(places.size() - index.size() - 4, 4, toBytes(lie.index_size));
  if (lie.fields_size != 0) places.replace(0, 4, toBytes(lie.fields_size));
  const auto header = [&](std::size_t index_pos) {
    return makeBagRecord(3,
                         {{"index_pos", toBytes(static_cast<std::uint32_t>(index_pos)) + toBytes(0)},
                          {"conn_count", toBytes(1)},
                          {"chunk_count", toBytes(lie.chunks)}},
                         "    ");
  };
  const std::size_t begin = rosbag1::kMagic.size() + header(0).size();
  std::string bag = std::string(rosbag1::kMagic) + header(begin + chunk.size() + places.size()) + chunk + places;
  bag += makeBagConnection();
  for (std::uint32_t i = 0; i < lie.chunks; ++i)
    bag += makeBagRecord(6,
                         {{"ver", toBytes(1)},
                          {"chunk_pos", toBytes(static_cast<std::uint32_t>(begin)) + toBytes(0)},
                          {"count", toBytes(1)}},
                         toBytes(0) + orElse(lie.messages, 20));
  return bag;
}

/// A bag that its recorder did not close: a chunk without compression, and messages after it.
std::string makeBag() {
  std::string index;
  const std::string records = makeBagRecords(index);
  const std::string chunk = makeBagRecord(
      5, {{"compression", "none"}, {"size", toBytes(static_cast<std::uint32_t>(records.size()))}}, records);
  const std::string open = makeBagRecord(5, {{"compression", "none"}, {"size", toBytes(0)}}, "");
  return std::string(rosbag1::kMagic) + makeBagRecord(3, {{"index_pos", toBytes(0) + toBytes(0)}}, "    ") + chunk +
         open + records;
}

/// Reads all messages by their own definition.
void readAll(Storage& storage) {
  for (std::size_t i = 0; i < storage.connections().size(); ++i) {
    const Connection& connection = storage.connections()[i];
    std::optional<Transcoder> transcoder;
    try {
      const MessageDefinition definition = parseDefinition(
          connection.type, connection.definition.empty() ? std::string(kDefinition) : connection.definition);
      transcoder.emplace(definition, withSequence(definition));
    } catch (const std::invalid_argument&) {
      continue;
    }
    for (const MessageEntry& entry : storage.index(i)) {
      const ByteView bytes = storage.read(i, entry);
      const std::optional<MessageEncoding> encoding = cdrEncoding(bytes);
      if (!encoding) continue;
      try {
        transcoder->convert(bytes, *encoding, MessageEncoding::Ros1);
        transcoder->convert(bytes, MessageEncoding::Ros1, MessageEncoding::CdrLittleEndian);
      } catch (const std::runtime_error&) {
        continue;
      }
    }
  }
  storage.warnings();
}

template <typename Open>
void expectToSurvive(const std::vector<std::string>& seeds, const Open& open) {
  const auto read = [&](const std::string& path) {
    try {
      readAll(*open(path));
    } catch (const urban_nav_core::DataError&) {
      return;
    }
  };
  EXPECT_EQ(urban_nav_core::testing::fuzzFile(seeds, "a", read).failure.substr(0, 300), "");
}

TEST(StorageFuzz, DamagedMcap) { expectToSurvive({makeChunked(), makeUnchunked(), makeUnfinished()}, openMcapStorage); }

TEST(StorageFuzz, DamagedBag) { expectToSurvive({makeBag()}, openScannedBag); }

TEST(StorageFuzz, DamagedIndexOfABag) { expectToSurvive({makeIndexedBag()}, openBagRecords); }

/// Numbers that librosbag did not check: it allocated as much, ended the process, or read beyond the chunk.
TEST(StorageFuzz, WrongNumbersInABagLoseNoMessageAndAllocateNoMemory) {
  constexpr std::uint32_t kFar = 0xfffffff0;
  const std::string path = (fs::temp_directory_path() / ("storage_lies_" + std::to_string(getpid()))).string();
  const auto open = [&](const IndexLie& lie) {
    std::ofstream(path, std::ios::binary) << makeIndexedBag(lie);
    return openBagRecords(path);
  };
  const std::unique_ptr<Storage> whole = open({});
  EXPECT_EQ(whole->index(0).size(), 20U);
  EXPECT_TRUE(whole->warnings().empty());
  IndexLie messages, offset, index_size, fields_size, chunks;
  messages.messages = kFar;
  offset.offset = kFar;
  index_size.index_size = kFar;
  fields_size.fields_size = kFar;
  chunks.chunks = 1000;  // each of them the same
  for (const IndexLie& lie : {messages, offset, index_size, fields_size, chunks}) {
    const std::unique_ptr<Storage> storage = open(lie);
    ASSERT_EQ(storage->connections().size(), 1U);
    ASSERT_EQ(storage->index(0).size(), 20U) << "by its records";
    for (const MessageEntry& entry : storage->index(0)) EXPECT_GT(storage->read(0, entry).size, 0U);
    EXPECT_EQ(storage->warnings().size(), 1U);
  }
  for (const char* compression : {"bz2", "lz4"}) {
    IndexLie size;
    size.chunk_size = kFar;
    size.compression = compression;
    const std::unique_ptr<Storage> storage = open(size);
    for (const MessageEntry& entry : storage->index(0)) EXPECT_EQ(storage->read(0, entry).data, nullptr);
    EXPECT_EQ(storage->warnings().size(), 1U);
  }
  IndexLie packed;
  packed.packed_size = kFar;
  EXPECT_EQ(open(packed)->index(0).size(), 20U) << "of a chunk that is cut off";
  fs::remove(path);
}

TEST(StorageFuzz, WhatExceedsTheMemoryLimitIsNotDecompressed) {
  const urban_nav_core::testing::LimitedMemory limit(std::size_t{8} << 20U);
  const std::vector<char> zeros(std::size_t{1} << 20U);
  std::vector<std::uint8_t> packed(ZSTD_compressBound(zeros.size() + 1));
  for (const std::size_t more : {0U, 1U}) {
    const std::vector<char> plain(zeros.size() + more);
    const std::size_t size = ZSTD_compress(packed.data(), packed.size(), plain.data(), plain.size(), 3);
    ASSERT_LT(size, 1000U);
    EXPECT_EQ(inflate("zstd", {packed.data(), size}, plain.size()).is_whole, more == 0);
    EXPECT_EQ(MessageUnpacker()({packed.data(), size}).size, more == 0 ? plain.size() : 0U);
  }
  EXPECT_EQ(inflate("lz4", {packed.data(), 10}, zeros.size() + 1).memory, nullptr);
  EXPECT_EQ(inflate("bz2", {packed.data(), 10}, zeros.size() + 1).memory, nullptr);
}

TEST(StorageFuzz, DamagedDb3) { expectToSurvive({makeDb3()}, openDb3Storage); }

TEST(StorageFuzz, DamagedMetadata) {
  const std::string seed =
      "rosbag2_bagfile_information:\n  version: 5\n  compression_format: zstd\n  compression_mode: FILE\n"
      "  relative_file_paths:\n    - a_0.db3\n    - a_1.db3\n  topics_with_message_count:\n    - topic_metadata:\n"
      "        name: /a\n        serialization_format: cdr\n      message_count: 7\n";
  EXPECT_EQ(urban_nav_core::testing::fuzzFile({seed}, "metadata.yaml", readRosbag2Metadata).failure.substr(0, 300), "");
}

TEST(StorageFuzz, DamagedCompressedFile) {
  const std::string plain = makeUnchunked();
  std::string packed(ZSTD_compressBound(plain.size()), '\0');
  packed.resize(ZSTD_compress(packed.data(), packed.size(), plain.data(), plain.size(), 1));
  const auto read = [](const std::string& path) {
    peekZstdFile(path, 16);
    try {
      const UnpackedFile file(path);
      readAll(*openMcapStorage(file.path()));
    } catch (const urban_nav_core::DataError&) {
      return;
    }
  };
  EXPECT_EQ(urban_nav_core::testing::fuzzFile({packed}, "a.mcap.zstd", read).failure.substr(0, 300), "");
}

TEST(StorageFuzz, SeedsAreReadWhole) {
  const std::string path = (fs::temp_directory_path() / ("storage_fuzz_" + std::to_string(getpid()))).string();
  std::ofstream(path, std::ios::binary) << makeUnchunked();
  const std::unique_ptr<Storage> mcap = openMcapStorage(path);
  EXPECT_EQ(mcap->index(0).size(), 20U);
  std::ofstream(path, std::ios::binary) << makeUnfinished();
  EXPECT_EQ(openMcapStorage(path)->index(0).size(), 40U);
  std::ofstream(path, std::ios::binary) << makeBag();
  EXPECT_EQ(openScannedBag(path)->index(0).size(), 40U);
  std::ofstream(path, std::ios::binary) << makeDb3();
  const std::unique_ptr<Storage> db3 = openDb3Storage(path);
  EXPECT_EQ(db3->index(0).size(), 20U);
  EXPECT_EQ(db3->read(0, db3->index(0).front()).size, 20U);
  fs::remove(path);
}

TEST(StorageFuzz, DamagedDefinitions) {
  const auto read = [](const std::string& text) {
    try {
      const MessageDefinition definition = parseDefinition("a/B", text);
      parseDefinition("a/B", printRos2(definition));
      computeMd5(definition);
    } catch (const std::invalid_argument&) {
      return;
    }
  };
  const std::vector<std::string> seeds = {
      "std_msgs/Header header\nstring<=5 x \"a\"\nfloat64[9] k\nint8 A=1\nC[<=3] c\n====\nMSG: a/C\nint16 v\n"
      "====\nMSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n"};
  EXPECT_EQ(urban_nav_core::testing::fuzzText(seeds, read).failure.substr(0, 300), "");
}

}  // namespace
}  // namespace urban_nav_input
