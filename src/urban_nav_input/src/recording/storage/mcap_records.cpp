// SPDX-License-Identifier: BSD-3-Clause
#include "recording/storage/mcap_records.hpp"

#include <algorithm>

#include "recording/storage/byte_reader.hpp"

namespace urban_nav_input::mcap {

namespace {

std::uint64_t readLength(const std::uint8_t* bytes) {
  std::uint64_t length = 0;
  std::memcpy(&length, bytes, sizeof(length));
  return length;
}

template <typename T>
std::optional<T> ifGood(const ByteReader& reader, T value) {
  return reader.isGood() ? std::optional<T>(std::move(value)) : std::nullopt;
}

}  // namespace

std::optional<Record> RecordWalk::next() {
  if (at_ > bytes_.size || bytes_.size - at_ < kRecordHead) return std::nullopt;
  const std::uint8_t* head = bytes_.data + at_;
  const std::uint64_t length = readLength(head + 1);
  if (length > bytes_.size - at_ - kRecordHead) return std::nullopt;
  const Record record{static_cast<Op>(head[0]), at_, {head + kRecordHead, static_cast<std::size_t>(length)}};
  at_ += kRecordHead + length;
  return record;
}

std::optional<Record> RecordWalk::cutRecord() const {
  if (at_ > bytes_.size || bytes_.size - at_ < kRecordHead) return std::nullopt;
  const std::uint8_t* head = bytes_.data + at_;
  return Record{static_cast<Op>(head[0]), at_, {head + kRecordHead, bytes_.size - at_ - kRecordHead}};
}

std::string parseProfile(const Record& header) {
  if (header.op != Op::Header) return {};
  ByteReader reader(header.content);
  std::string profile = reader.text();
  return reader.isGood() ? profile : std::string();
}

std::optional<Schema> parseSchema(ByteView content) {
  ByteReader reader(content);
  Schema schema;
  schema.id = reader.number<std::uint16_t>();
  schema.name = reader.text();
  schema.encoding = reader.text();
  schema.text = reader.text();
  return ifGood(reader, std::move(schema));
}

std::optional<Channel> parseChannel(ByteView content) {
  ByteReader reader(content);
  Channel channel;
  channel.id = reader.number<std::uint16_t>();
  channel.schema = reader.number<std::uint16_t>();
  channel.topic = reader.text();
  channel.encoding = reader.text();
  ByteReader entries(reader.bytes(reader.number<std::uint32_t>()));
  while (reader.isGood() && entries.isGood() && entries.left() > 0) {
    const std::string key = entries.text();
    channel.metadata[key] = entries.text();
  }
  return ifGood(reader, std::move(channel));
}

std::optional<Message> parseMessage(ByteView content) {
  ByteReader reader(content);
  Message message;
  message.channel = reader.number<std::uint16_t>();
  reader.number<std::uint32_t>();  // sequence
  message.log_time = reader.number<std::uint64_t>();
  reader.number<std::uint64_t>();  // publish time
  message.data = reader.rest();
  return ifGood(reader, message);
}

std::optional<Chunk> parseChunk(ByteView content) {
  ByteReader reader(content);
  Chunk chunk;
  chunk.start = reader.number<std::uint64_t>();
  chunk.end = reader.number<std::uint64_t>();
  chunk.size = reader.number<std::uint64_t>();
  chunk.crc = reader.number<std::uint32_t>();
  chunk.compression = reader.text();
  chunk.packed_size = reader.number<std::uint64_t>();
  if (!reader.isGood()) return std::nullopt;
  chunk.packed = reader.bytes(std::min<std::uint64_t>(reader.left(), chunk.packed_size));
  return chunk;
}

std::optional<MessageIndex> parseMessageIndex(ByteView content) {
  ByteReader reader(content);
  MessageIndex index;
  index.channel = reader.number<std::uint16_t>();
  index.entries = reader.bytes(reader.number<std::uint32_t>());
  return ifGood(reader, index);
}

std::optional<ChunkIndex> parseChunkIndex(ByteView content) {
  ByteReader reader(content);
  ChunkIndex index;
  index.start = reader.number<std::uint64_t>();
  index.end = reader.number<std::uint64_t>();
  index.offset = reader.number<std::uint64_t>();
  index.length = reader.number<std::uint64_t>();
  ByteReader entries(reader.bytes(reader.number<std::uint32_t>()));
  while (reader.isGood() && entries.isGood() && entries.left() > 0) {
    const auto channel = entries.number<std::uint16_t>();
    index.indexes[channel] = entries.number<std::uint64_t>();
  }
  reader.number<std::uint64_t>();  // length of the message indexes
  index.compression = reader.text();
  index.packed_size = reader.number<std::uint64_t>();
  index.size = reader.number<std::uint64_t>();
  return ifGood(reader, std::move(index));
}

std::optional<Footer> parseFooter(ByteView content) {
  ByteReader reader(content);
  Footer footer;
  footer.summary = reader.number<std::uint64_t>();
  footer.summary_offsets = reader.number<std::uint64_t>();
  footer.crc = reader.number<std::uint32_t>();
  return ifGood(reader, footer);
}

std::optional<Statistics> parseStatistics(ByteView content) {
  ByteReader reader(content);
  Statistics statistics;
  statistics.messages = reader.number<std::uint64_t>();
  reader.number<std::uint16_t>();  // schemas
  statistics.channels = reader.number<std::uint32_t>();
  reader.number<std::uint32_t>();  // attachments
  reader.number<std::uint32_t>();  // metadata
  statistics.chunks = reader.number<std::uint32_t>();
  return ifGood(reader, statistics);
}

}  // namespace urban_nav_input::mcap
