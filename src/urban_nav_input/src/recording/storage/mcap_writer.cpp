// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/recording/mcap_writer.hpp"

#include <zstd.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <tuple>

#include "recording/storage/byte_writer.hpp"
#include "recording/storage/crc32.hpp"
#include "recording/storage/mcap_records.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_input {

using mcap::Op;
using urban_nav_core::StampNs;

namespace {

constexpr std::size_t kChunkBytes = 1U << 20U;  // size of records at which a chunk is closed
constexpr int kLevel = 3;                       // the default of zstd
constexpr std::size_t kMostChannels = 65535;

void appendRecord(ByteWriter& out, Op op, const ByteWriter& content) {
  out.number(static_cast<std::uint8_t>(op)).number(static_cast<std::uint64_t>(content.size())).bytes(content.str());
}

template <typename Key, typename Value>
void appendMap(ByteWriter& out, const std::map<Key, Value>& map) {
  ByteWriter entries;
  for (const auto& [key, value] : map) entries.number(key).number(value);
  out.text(entries.str());
}

}  // namespace

class McapWriter::Impl {
 public:
  explicit Impl(const std::string& path) : path_(path), file_(path), context_(ZSTD_createCCtx(), ZSTD_freeCCtx) {
    append(std::string(mcap::kMagic));
    ByteWriter header, record;
    header.text("ros2").text("urban_nav");
    appendRecord(record, Op::Header, header);
    append(record.str());
  }

  std::uint16_t addChannel(const McapChannel& channel) {
    if (channels_.size() >= kMostChannels) throw urban_nav_core::UserError(path_, "holds too many topics", "65535");
    const auto schema = std::make_tuple(channel.type, channel.schema_encoding, channel.definition);
    const auto [known, is_new] = schemas_.try_emplace(schema, static_cast<std::uint16_t>(schemas_.size() + 1));
    ByteWriter content;
    if (is_new) {
      content.number(known->second).text(channel.type).text(channel.schema_encoding).text(channel.definition);
      appendRecord(schema_records_, Op::Schema, content);
      appendRecord(chunk_, Op::Schema, content);
      content.clear();
    }
    const auto id = static_cast<std::uint16_t>(channels_.size());
    ByteWriter metadata;
    for (const auto& [key, value] : channel.metadata) metadata.text(key).text(value);
    content.number(id).number(known->second).text(channel.topic).text(channel.encoding).text(metadata.str());
    appendRecord(channel_records_, Op::Channel, content);
    appendRecord(chunk_, Op::Channel, content);
    channels_.push_back({});
    return id;
  }

  void write(std::uint16_t channel, StampNs receipt, ByteView message) {
    const auto time = static_cast<std::uint64_t>(receipt);
    index_[channel].number(time).number(static_cast<std::uint64_t>(chunk_.size()));
    chunk_times_ = extend(chunk_times_, time);
    all_times_ = extend(all_times_, time);
    chunk_.number(static_cast<std::uint8_t>(Op::Message))
        .number(static_cast<std::uint64_t>(mcap::kMessageHead + message.size))
        .number(channel)
        .number(channels_[channel].sequence++)
        .number(time)
        .number(time)
        .bytes(message);
    if (chunk_.size() >= kChunkBytes) endChunk();
  }

  std::uint64_t size() const { return written_ + chunk_.size(); }

  void commit() {
    if (chunk_.size() > 0) endChunk();
    ByteWriter end, record;
    end.number(data_crc_);
    appendRecord(record, Op::DataEnd, end);
    append(record.str());
    writeSummary();
    append(std::string(mcap::kMagic));
    file_.commit();
  }

 private:
  struct ChannelState {
    std::uint32_t sequence = 0;  // number of the next message
  };
  using Times = std::optional<std::pair<std::uint64_t, std::uint64_t>>;

  static Times extend(const Times& times, std::uint64_t time) {
    return times ? std::pair(std::min(times->first, time), std::max(times->second, time)) : std::pair(time, time);
  }

  void append(const std::string& bytes) {
    file_.write(bytes);
    data_crc_ = crc32({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, data_crc_);
    written_ += bytes.size();
  }

  std::string compress() {
    std::string packed(ZSTD_compressBound(chunk_.size()), '\0');
    const std::size_t size =
        ZSTD_compressCCtx(context_.get(), packed.data(), packed.size(), chunk_.str().data(), chunk_.size(), kLevel);
    if (ZSTD_isError(size) != 0) throw std::runtime_error(ZSTD_getErrorName(size));
    packed.resize(size);
    return packed;
  }

  void endChunk() {
    const std::string packed = compress();
    const auto [first, last] = chunk_times_.value_or(std::pair<std::uint64_t, std::uint64_t>(0, 0));
    ByteWriter head, record;
    head.number(first).number(last).number(static_cast<std::uint64_t>(chunk_.size())).number(crc32(chunk_.view()));
    head.text("zstd").number(static_cast<std::uint64_t>(packed.size()));
    record.number(static_cast<std::uint8_t>(Op::Chunk))
        .number(static_cast<std::uint64_t>(head.size() + packed.size()))
        .bytes(head.str());
    const std::uint64_t begin = written_, length = record.size() + packed.size();
    append(record.str());
    append(packed);
    ByteWriter index;
    index.number(first).number(last).number(begin).number(length);
    const std::uint64_t indexes_begin = written_;
    appendMap(index, writeIndexes());
    index.number(written_ - indexes_begin).text("zstd");
    index.number(static_cast<std::uint64_t>(packed.size())).number(static_cast<std::uint64_t>(chunk_.size()));
    appendRecord(chunk_indexes_, Op::ChunkIndex, index);
    ++chunks_;
    chunk_.clear();
    chunk_times_.reset();
  }

  /// Writes the indexes; returns their positions by channel.
  std::map<std::uint16_t, std::uint64_t> writeIndexes() {
    std::map<std::uint16_t, std::uint64_t> places;
    for (const auto& [channel, entries] : index_) {
      places[channel] = written_;
      ByteWriter content, record;
      content.number(channel).text(entries.str());
      appendRecord(record, Op::MessageIndex, content);
      append(record.str());
    }
    index_.clear();
    return places;
  }

  ByteWriter statistics() const {
    ByteWriter content;
    std::uint64_t messages = 0;
    std::map<std::uint16_t, std::uint64_t> counts;
    for (std::size_t i = 0; i < channels_.size(); ++i) {
      messages += channels_[i].sequence;
      if (channels_[i].sequence > 0) counts[static_cast<std::uint16_t>(i)] = channels_[i].sequence;
    }
    const auto [first, last] = all_times_.value_or(std::pair<std::uint64_t, std::uint64_t>(0, 0));
    content.number(messages).number(static_cast<std::uint16_t>(schemas_.size()));
    content.number(static_cast<std::uint32_t>(channels_.size())).number(std::uint32_t{0}).number(std::uint32_t{0});
    content.number(chunks_).number(first).number(last);
    appendMap(content, counts);
    ByteWriter record;
    appendRecord(record, Op::Statistics, content);
    return record;
  }

  void writeSummary() {
    const std::uint64_t begin = written_;
    ByteWriter summary, offsets;
    const auto group = [&](Op op, const ByteWriter& records) {
      if (records.size() == 0) return;
      ByteWriter content;
      content.number(static_cast<std::uint8_t>(op)).number(begin + summary.size());
      content.number(static_cast<std::uint64_t>(records.size()));
      appendRecord(offsets, Op::SummaryOffset, content);
      summary.bytes(records.str());
    };
    group(Op::Schema, schema_records_);
    group(Op::Channel, channel_records_);
    group(Op::Statistics, statistics());
    group(Op::ChunkIndex, chunk_indexes_);
    const std::uint64_t offsets_begin = begin + summary.size();
    summary.bytes(offsets.str());
    summary.number(static_cast<std::uint8_t>(Op::Footer)).number(std::uint64_t{20});
    summary.number(begin).number(offsets_begin);
    summary.number(crc32(summary.view()));
    append(summary.str());
  }

  const std::string path_;
  urban_nav_core::AtomicFile file_;
  const std::unique_ptr<ZSTD_CCtx, std::size_t (*)(ZSTD_CCtx*)> context_;
  std::map<std::tuple<std::string, std::string, std::string>, std::uint16_t> schemas_;
  std::vector<ChannelState> channels_;
  ByteWriter schema_records_, channel_records_, chunk_indexes_;  // for the summary
  ByteWriter chunk_;                                             // records of the current chunk
  std::map<std::uint16_t, ByteWriter> index_;                    // for this chunk, by channel
  Times chunk_times_, all_times_;                                // ns
  std::uint32_t chunks_ = 0, data_crc_ = 0;
  std::uint64_t written_ = 0;
};

McapWriter::McapWriter(const std::string& path) : impl_(std::make_unique<Impl>(path)) {}
McapWriter::~McapWriter() = default;

std::uint16_t McapWriter::addChannel(const McapChannel& channel) { return impl_->addChannel(channel); }

void McapWriter::write(std::uint16_t channel, StampNs receipt, ByteView message) {
  impl_->write(channel, receipt, message);
}

std::uint64_t McapWriter::size() const { return impl_->size(); }

void McapWriter::commit() { impl_->commit(); }

}  // namespace urban_nav_input
