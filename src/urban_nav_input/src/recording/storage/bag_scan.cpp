// SPDX-License-Identifier: BSD-3-Clause
#include "recording/storage/bag_scan.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "recording/storage/bag_records.hpp"
#include "recording/storage/inflate.hpp"
#include "urban_nav_core/io/memory_limit.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_input {

using rosbag1::findField;
using rosbag1::findNumber;
using rosbag1::findText;
using urban_nav_core::StampNs;
using urban_nav_core::UserError;

namespace {

constexpr std::size_t kLargestOpenChunk = 1U << 28U;  // bytes of a chunk whose size was not written yet

std::string counted(std::uint64_t number, const char* one, const char* many) {
  return std::to_string(number) + " " + (number == 1 ? one : many);
}

/// Reads all records of a bag in order.
class BagWalk {
 public:
  BagWalk(std::string path, ByteView file) : path_(std::move(path)), file_(file) {}

  BagScan run() {
    rosbag1::RecordWalk walk(file_, rosbag1::kMagic.size());
    bool is_closed = false, is_open_chunk = false;
    while (std::optional<rosbag1::Record> record = walk.next()) {
      if (record->op == rosbag1::Op::BagHeader) {
        is_closed = checkHeader(*record);
      } else if (record->op == rosbag1::Op::Chunk) {
        is_open_chunk = isOpen(*record);
        if (is_open_chunk) record->data = rest(walk.at());
        visitChunk(*record, is_open_chunk);
        if (is_open_chunk) break;
      } else {
        visit(*record, kNoChunk);
      }
    }
    if (const std::optional<rosbag1::Record> cut = walk.cutRecord(); cut && cut->op == rosbag1::Op::Chunk)
      visitChunk(*cut, true);
    describeEnd(is_open_chunk ? file_.size : walk.at(), is_closed);
    return std::move(scan_);
  }

 private:
  /// Returns whether the recorder has finished the bag. Throws UserError if it is encrypted.
  bool checkHeader(const rosbag1::Record& record) const {
    const std::string encryptor = findText(record.header, "encryptor");
    if (!encryptor.empty())
      throw UserError(path_, "is encrypted by " + encryptor, "a bag that is not (rosbag decrypt)");
    return findNumber<std::uint64_t>(record.header, "index_pos").value_or(0) != 0;
  }

  /// Returns whether the bag was truncated while the recorder was writing the chunk, whose size is written at its end.
  /// Records of an uncompressed chunk follow its header like those outside of chunks.
  static bool isOpen(const rosbag1::Record& record) {
    return record.data_size == 0 && findNumber<std::uint32_t>(record.header, "size").value_or(0) == 0 &&
           findText(record.header, "compression") != "none";
  }

  ByteView rest(std::uint64_t begin) const {
    return {file_.data + begin, file_.size - static_cast<std::size_t>(begin)};
  }

  /// `is_cut`: the chunk is truncated by the end of the file.
  void visitChunk(const rosbag1::Record& record, bool is_cut) {
    std::optional<McapChunk> read = readChunk(record);
    if (!read)
      throw UserError(path_, "is compressed by " + findText(record.header, "compression") + ", which is not supported",
                      "none, bz2 or lz4");
    McapChunk& chunk = *read;
    if (is_cut) chunk.chunk.packed_size = std::max<std::uint64_t>(record.data_size, record.data.size + 1);
    if (is_cut && chunk.chunk.size == 0) chunk.chunk.size = std::min(kLargestOpenChunk, urban_nav_core::largestPiece());
    Inflated inflated;
    ByteView bytes = record.data;
    if (!chunk.chunk.compression.empty()) {
      inflated = inflate(chunk.chunk.compression, record.data, static_cast<std::size_t>(chunk.chunk.size));
      bytes = inflated.bytes();
      if (!is_cut && !inflated.is_whole) {
        scan_.warnings.push_back("chunk at byte " + std::to_string(record.begin) +
                                 " cannot be decompressed: its messages are left out");
        return;
      }
    }
    rosbag1::RecordWalk walk(bytes);
    const std::uint64_t number = scan_.chunks.size();
    while (const std::optional<rosbag1::Record> inner = walk.next()) visit(*inner, number);
    if (!is_cut && walk.at() != bytes.size)
      scan_.warnings.push_back("chunk at byte " + std::to_string(record.begin) + " is damaged at its byte " +
                               std::to_string(walk.at()) + ": the messages after it are left out");
    scan_.chunks.push_back(std::move(*read));
  }

  void visit(const rosbag1::Record& record, std::uint64_t chunk) {
    if (record.op != rosbag1::Op::Connection && record.op != rosbag1::Op::Message) return;
    const std::optional<std::uint32_t> id = findNumber<std::uint32_t>(record.header, "conn");
    if (record.op == rosbag1::Op::Connection) {
      if (id) addConnection(*id, record);
      return;
    }
    const std::optional<std::uint64_t> time = findNumber<std::uint64_t>(record.header, "time");
    const auto known = id ? places_.find(*id) : places_.end();
    if (known == places_.end() || !time) {
      ++orphans_;
      return;
    }
    scan_.entries[known->second].push_back({readBagTime(*time), makePlace(chunk, record.begin)});
    ++scan_.messages;
  }

  void addConnection(std::uint32_t id, const rosbag1::Record& record) {
    if (!places_.try_emplace(id, scan_.connections.size()).second) return;
    scan_.connections.push_back(readConnection(record));
    scan_.ids.push_back(id);
    scan_.entries.emplace_back();
  }

  void describeEnd(std::uint64_t end, bool is_closed) {
    const std::string used =
        ": the " + counted(scan_.messages, "message that is whole is used", "whole messages are used");
    if (end < file_.size || is_closed)
      scan_.warnings.push_back("is cut off or damaged at byte " + std::to_string(end) + " of " +
                               std::to_string(file_.size) + used);
    else scan_.warnings.push_back("was not closed by its recorder and has no index" + used);
    if (orphans_ > 0)
      scan_.warnings.push_back(counted(orphans_, "message belongs", "messages belong") +
                               " to no connection and are left out");
  }

  const std::string path_;
  const ByteView file_;
  BagScan scan_;
  std::map<std::uint32_t, std::size_t> places_;  // places of connections, key: id
  std::uint64_t orphans_ = 0;
};

}  // namespace

Connection readConnection(const rosbag1::Record& record) {
  Connection connection;
  connection.topic = findText(record.header, "topic");
  connection.type = findText(record.data, "type");
  connection.md5 = findText(record.data, "md5sum");
  connection.definition = findText(record.data, "message_definition");
  connection.definition_encoding = "ros1msg";
  connection.encoding = "ros1";
  connection.caller_id = findText(record.data, "callerid");
  connection.is_latched = findText(record.data, "latching") == "1";
  return connection;
}

std::optional<McapChunk> readChunk(const rosbag1::Record& record) {
  const std::string compression = findText(record.header, "compression");
  if (compression != "none" && compression != "bz2" && compression != "lz4") return std::nullopt;
  McapChunk chunk;
  chunk.begin = record.begin;
  chunk.chunk.compression = compression == "none" ? "" : compression;
  chunk.chunk.size = findNumber<std::uint32_t>(record.header, "size").value_or(0);
  chunk.chunk.packed = record.data;
  chunk.chunk.packed_size = record.data_size;
  return chunk;
}

StampNs readBagTime(std::uint64_t time) {
  const auto seconds = static_cast<StampNs>(time & std::numeric_limits<std::uint32_t>::max());
  return seconds * 1'000'000'000 + static_cast<StampNs>(time >> 32U);
}

BagScan scanBag(const std::string& path, ByteView file) { return BagWalk(path, file).run(); }

}  // namespace urban_nav_input
