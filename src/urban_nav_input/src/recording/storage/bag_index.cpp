// SPDX-License-Identifier: BSD-3-Clause
#include "recording/storage/bag_index.hpp"

#include <cstdint>
#include <map>
#include <utility>

#include "recording/storage/bag_records.hpp"
#include "recording/storage/byte_reader.hpp"

namespace urban_nav_input {

using rosbag1::findNumber;
using rosbag1::findText;
using rosbag1::Record;
using rosbag1::RecordWalk;
using urban_nav_core::StampNs;

namespace {

constexpr std::uint32_t kVersion = 1;          // of index and chunk info records
constexpr std::size_t kIndexEntry = 8 + 4;     // time and offset, bytes
constexpr std::size_t kCountedConnection = 8;  // connection and number of its messages, bytes

/// Reads the index of one bag; the functions return false if it is inconsistent.
class BagIndex {
 public:
  explicit BagIndex(ByteView file) : file_(file) {}

  std::optional<BagScan> read() {
    const std::optional<Record> header = RecordWalk(file_, rosbag1::kMagic.size()).next();
    if (!header || header->op != rosbag1::Op::BagHeader || !findText(header->header, "encryptor").empty())
      return std::nullopt;
    const std::uint64_t index = findNumber<std::uint64_t>(header->header, "index_pos").value_or(0);
    const std::optional<std::uint32_t> connections = findNumber<std::uint32_t>(header->header, "conn_count");
    const std::optional<std::uint32_t> chunks = findNumber<std::uint32_t>(header->header, "chunk_count");
    if (index == 0 || index > file_.size || !connections || !chunks || *chunks >= kNoChunk) return std::nullopt;
    RecordWalk walk(file_, index);
    while (const std::optional<Record> record = walk.next()) {
      const bool is_good = record->op == rosbag1::Op::Connection
                               ? addConnection(*record)
                               : record->op == rosbag1::Op::ChunkInfo && addChunk(*record);
      if (!is_good) return std::nullopt;
    }
    const bool is_whole = walk.at() == file_.size && found_.size() == *connections && scan_.chunks.size() == *chunks;
    return is_whole && finish() ? std::optional<BagScan>(std::move(scan_)) : std::nullopt;
  }

 private:
  bool addConnection(const Record& record) {
    const std::optional<std::uint32_t> id = findNumber<std::uint32_t>(record.header, "conn");
    return id && found_.try_emplace(*id, readConnection(record)).second;
  }

  /// Adds a chunk and its messages from its index records.
  bool addChunk(const Record& info) {
    const std::optional<std::uint64_t> begin = findNumber<std::uint64_t>(info.header, "chunk_pos");
    // With overlapping chunks, a small file could refer to the same messages millions of times.
    if (!begin || *begin < end_ || *begin >= file_.size) return false;
    if (findNumber<std::uint32_t>(info.header, "ver") != kVersion) return false;
    RecordWalk walk(file_, *begin);
    const std::optional<Record> record = walk.next();
    if (!record || record->op != rosbag1::Op::Chunk) return false;
    std::optional<McapChunk> chunk = readChunk(*record);
    if (!chunk) return false;
    std::size_t indexes = 0, expected = 0;
    ByteReader counts(info.data);
    for (; counts.left() >= kCountedConnection; ++indexes) {
      counts.number<std::uint32_t>();
      expected += counts.number<std::uint32_t>();
    }
    std::size_t messages = 0;
    for (std::size_t i = 0; i < indexes; ++i) {
      const std::optional<Record> index = walk.next();
      if (!index || index->op != rosbag1::Op::Index || !addEntries(*index, chunk->chunk.size, messages)) return false;
    }
    scan_.chunks.push_back(std::move(*chunk));
    scan_.messages += messages;
    end_ = walk.at();
    return messages == expected;
  }

  bool addEntries(const Record& index, std::uint64_t chunk_size, std::size_t& messages) {
    const std::optional<std::uint32_t> id = findNumber<std::uint32_t>(index.header, "conn");
    const std::optional<std::uint32_t> count = findNumber<std::uint32_t>(index.header, "count");
    if (!id || !count || findNumber<std::uint32_t>(index.header, "ver") != kVersion) return false;
    if (index.data.size != kIndexEntry * std::size_t{*count}) return false;
    std::vector<MessageEntry>& entries = pending_[*id];
    ByteReader reader(index.data);
    for (std::uint32_t i = 0; i < *count; ++i) {
      const StampNs time = readBagTime(reader.number<std::uint64_t>());
      const std::uint64_t offset = reader.number<std::uint32_t>();
      if (offset >= chunk_size) return false;
      entries.push_back({time, makePlace(scan_.chunks.size(), offset)});
    }
    messages += *count;
    return true;
  }

  bool finish() {
    for (auto& [id, entries] : pending_) {
      const auto known = found_.find(id);
      if (known == found_.end()) return false;
      if (entries.empty()) continue;
      scan_.connections.push_back(std::move(known->second));
      scan_.ids.push_back(id);
      scan_.entries.push_back(std::move(entries));
    }
    return true;
  }

  const ByteView file_;
  BagScan scan_;
  std::uint64_t end_ = rosbag1::kMagic.size();                  // of the last chunk with its index records
  std::map<std::uint32_t, Connection> found_;                   // key: id
  std::map<std::uint32_t, std::vector<MessageEntry>> pending_;  // key: id
};

}  // namespace

std::optional<BagScan> readBagIndex(ByteView file) { return BagIndex(file).read(); }

}  // namespace urban_nav_input
