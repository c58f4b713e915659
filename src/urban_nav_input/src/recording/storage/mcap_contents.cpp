// SPDX-License-Identifier: BSD-3-Clause
#include "recording/storage/mcap_contents.hpp"

#include <optional>
#include <utility>

#include "recording/storage/crc32.hpp"
#include "recording/storage/inflate.hpp"
#include "recording/storage/mcap_summary.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_input {

using mcap::Op;

namespace {

void checkCompression(const std::string& path, const std::string& compression) {
  if (!isKnownCompression(compression))
    throw urban_nav_core::UserError(path, "is compressed by " + compression + ", which is not supported",
                                    "none, lz4 or zstd");
}

/// Reads all records of a file in order.
class McapScan {
 public:
  McapScan(std::string path, ByteView file) : path_(std::move(path)), file_(file) {}

  McapContents run() {
    mcap::RecordWalk walk(file_, mcap::kMagic.size());
    bool is_whole = false;
    while (const std::optional<mcap::Record> record = walk.next()) {
      is_whole = record->op == Op::DataEnd || record->op == Op::Footer;
      if (is_whole) break;
      if (record->op == Op::Chunk) visitChunk(*record, false);
      else visit(*record, kNoChunk);
    }
    if (!is_whole) {
      const std::optional<mcap::Record> cut = walk.cutRecord();
      if (cut && cut->op == Op::Chunk) visitChunk(*cut, true);
      contents_.warnings.push_back("is cut off at byte " + std::to_string(walk.at()) + " of " +
                                   std::to_string(file_.size) + ": the " + std::to_string(messages_) +
                                   (messages_ == 1 ? " intact message is used" : " intact messages are used"));
    } else if (!endsWithMagic()) {
      contents_.warnings.push_back("is cut off after its messages: all " + std::to_string(messages_) + " are used");
    }
    if (orphans_ > 0)
      contents_.warnings.push_back(std::to_string(orphans_) +
                                   (orphans_ == 1 ? " message belongs" : " messages belong") +
                                   " to no channel and are left out");
    return std::move(contents_);
  }

 private:
  bool endsWithMagic() const {
    const std::string_view all(reinterpret_cast<const char*>(file_.data), file_.size);
    return all.size() >= mcap::kMagic.size() && all.substr(all.size() - mcap::kMagic.size()) == mcap::kMagic;
  }

  void visit(const mcap::Record& record, std::uint64_t chunk) {
    if (record.op == Op::Schema) {
      if (auto schema = mcap::parseSchema(record.content)) contents_.schemas[schema->id] = std::move(*schema);
    } else if (record.op == Op::Channel) {
      if (auto channel = mcap::parseChannel(record.content)) contents_.channels[channel->id] = std::move(*channel);
    } else if (record.op == Op::Message) {
      const std::optional<mcap::Message> message = mcap::parseMessage(record.content);
      if (!message || contents_.channels.count(message->channel) == 0) {
        ++orphans_;
        return;
      }
      ++messages_;
      contents_.entries[message->channel].push_back(
          {static_cast<urban_nav_core::StampNs>(message->log_time), makePlace(chunk, record.begin)});
    }
  }

  /// `is_cut`: the record is truncated by the end of the file.
  void visitChunk(const mcap::Record& record, bool is_cut) {
    std::optional<mcap::Chunk> chunk = mcap::parseChunk(record.content);
    if (!chunk) return warn(record, is_cut ? "is cut off" : "is damaged");
    checkCompression(path_, chunk->compression);
    Inflated inflated;
    ByteView bytes = chunk->packed;
    if (!chunk->compression.empty()) {
      inflated = inflate(chunk->compression, chunk->packed, static_cast<std::size_t>(chunk->size));
      bytes = inflated.bytes();
      if (!is_cut && !inflated.is_whole) return warn(record, "cannot be decompressed");
    }
    if (!is_cut && chunk->crc != 0 && crc32(bytes) != chunk->crc) return warn(record, "has a wrong checksum");
    mcap::RecordWalk walk(bytes);
    const std::uint64_t number = contents_.chunks.size();
    while (const std::optional<mcap::Record> inner = walk.next()) visit(*inner, number);
    contents_.chunks.push_back({record.begin, std::move(*chunk), {}});
  }

  void warn(const mcap::Record& record, const std::string& what) {
    contents_.warnings.push_back("chunk at byte " + std::to_string(record.begin) + " " + what +
                                 ": its messages are left out");
  }

  const std::string path_;
  const ByteView file_;
  McapContents contents_;
  std::uint64_t messages_ = 0, orphans_ = 0;
};

}  // namespace

McapContents readMcapContents(const std::string& path, ByteView file) {
  if (std::optional<McapContents> contents = readMcapSummary(file)) {
    for (const McapChunk& chunk : contents->chunks) checkCompression(path, chunk.chunk.compression);
    return std::move(*contents);
  }
  return McapScan(path, file).run();
}

}  // namespace urban_nav_input
