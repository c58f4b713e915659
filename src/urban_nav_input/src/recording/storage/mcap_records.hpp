// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_input/recording/byte_view.hpp"

namespace urban_nav_input::mcap {

/// Records of the MCAP format, version 0 (mcap.dev/spec).
enum class Op : std::uint8_t {
  Header = 1,
  Footer = 2,
  Schema = 3,
  Channel = 4,
  Message = 5,
  Chunk = 6,
  MessageIndex = 7,
  ChunkIndex = 8,
  Statistics = 11,
  SummaryOffset = 14,
  DataEnd = 15
};

constexpr std::string_view kMagic("\x89MCAP0\r\n", 8);
constexpr std::size_t kRecordHead = 9;                 // bytes: kind and length
constexpr std::size_t kMessageHead = 22;               // bytes of a message record before the message
constexpr std::size_t kFooterSize = kRecordHead + 20;  // bytes

struct Record {
  Op op = Op::Header;
  std::uint64_t begin = 0;  ///< position in the bytes
  ByteView content;
};

/// Iterates over records. Not thread-safe.
class RecordWalk {
 public:
  explicit RecordWalk(ByteView bytes, std::uint64_t begin = 0) : bytes_(bytes), at_(begin) {}

  /// Returns the next complete record; nullopt at the end, and if the next one is truncated.
  std::optional<Record> next();
  /// Returns the end of the last record.
  std::uint64_t at() const { return at_; }
  /// Returns the truncated record at this position, with its available data; nullopt if its head is incomplete.
  std::optional<Record> cutRecord() const;

 private:
  ByteView bytes_;
  std::uint64_t at_;
};

/// Returns the profile of a header, usually "ros1" or "ros2"; empty: none, or another kind of record.
std::string parseProfile(const Record& header);

struct Schema {
  std::uint16_t id = 0;
  std::string name, encoding, text;
};
std::optional<Schema> parseSchema(ByteView content);

struct Channel {
  std::uint16_t id = 0, schema = 0;
  std::string topic, encoding;
  std::map<std::string, std::string> metadata;
};
std::optional<Channel> parseChannel(ByteView content);

struct Message {
  std::uint16_t channel = 0;
  std::uint64_t log_time = 0;  ///< ns, receipt
  ByteView data;
};
std::optional<Message> parseMessage(ByteView content);

struct Chunk {
  std::uint64_t start = 0, end = 0;  ///< ns
  std::uint64_t size = 0;            ///< uncompressed, bytes
  std::uint32_t crc = 0;             ///< CRC of the uncompressed records; 0: unknown
  std::string compression;
  std::uint64_t packed_size = 0;  ///< bytes
  ByteView packed;                ///< fewer than packed_size if the file is truncated
};
/// Returns the chunk of a complete record, or of one truncated after its head.
std::optional<Chunk> parseChunk(ByteView content);

struct MessageIndex {
  std::uint16_t channel = 0;
  ByteView entries;  ///< 16 bytes each: log time, offset in the chunk
};
constexpr std::size_t kIndexEntry = 16;  // bytes
std::optional<MessageIndex> parseMessageIndex(ByteView content);

struct ChunkIndex {
  std::uint64_t start = 0, end = 0, offset = 0, length = 0;
  std::map<std::uint16_t, std::uint64_t> indexes;  ///< offset of the MessageIndex by channel
  std::string compression;
  std::uint64_t packed_size = 0, size = 0;
};
std::optional<ChunkIndex> parseChunkIndex(ByteView content);

struct Footer {
  std::uint64_t summary = 0, summary_offsets = 0;  ///< position in the file; 0: absent
  std::uint32_t crc = 0;                           ///< CRC of the summary before this field; 0: unknown
};
std::optional<Footer> parseFooter(ByteView content);

struct Statistics {
  std::uint64_t messages = 0;
  std::uint32_t channels = 0, chunks = 0;
};
std::optional<Statistics> parseStatistics(ByteView content);

}  // namespace urban_nav_input::mcap
