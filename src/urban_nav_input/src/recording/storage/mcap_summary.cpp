// SPDX-License-Identifier: BSD-3-Clause
#include "recording/storage/mcap_summary.hpp"

#include <algorithm>
#include <utility>

#include "recording/storage/byte_reader.hpp"
#include "recording/storage/crc32.hpp"

namespace urban_nav_input {

using mcap::Op;

namespace {

/// Returns the records of the summary; nullopt for a wrong checksum.
std::optional<ByteView> findSummary(ByteView file) {
  const std::size_t tail = mcap::kFooterSize + mcap::kMagic.size();
  if (file.size < mcap::kMagic.size() + tail) return std::nullopt;
  const std::size_t footer_begin = file.size - tail;
  if (std::memcmp(file.data + file.size - mcap::kMagic.size(), mcap::kMagic.data(), mcap::kMagic.size()) != 0)
    return std::nullopt;
  const std::optional<mcap::Record> record = mcap::RecordWalk(file, footer_begin).next();
  if (!record || record->op != Op::Footer) return std::nullopt;
  const std::optional<mcap::Footer> footer = mcap::parseFooter(record->content);
  if (!footer || footer->summary < mcap::kMagic.size() || footer->summary >= footer_begin) return std::nullopt;
  const std::size_t hashed = footer_begin + mcap::kFooterSize - sizeof(footer->crc) - footer->summary;
  if (footer->crc != 0 && crc32({file.data + footer->summary, hashed}) != footer->crc) return std::nullopt;
  return ByteView{file.data + footer->summary, footer_begin - footer->summary};
}

/// Returns the number of messages in the indexes of a chunk; nullopt if an index is missing.
std::optional<std::uint64_t> countIndexed(ByteView file, const McapChunk& chunk) {
  std::uint64_t count = 0;
  for (const auto& [channel, offset] : chunk.indexes) {
    const std::optional<mcap::Record> record = mcap::RecordWalk(file, offset).next();
    if (!record || record->op != Op::MessageIndex) return std::nullopt;
    const std::optional<mcap::MessageIndex> index = mcap::parseMessageIndex(record->content);
    if (!index || index->channel != channel) return std::nullopt;
    count += index->entries.size / mcap::kIndexEntry;
  }
  return count;
}

std::optional<McapChunk> findChunk(ByteView file, const mcap::ChunkIndex& index) {
  const std::optional<mcap::Record> record = mcap::RecordWalk(file, index.offset).next();
  if (!record || record->op != Op::Chunk) return std::nullopt;
  std::optional<mcap::Chunk> chunk = mcap::parseChunk(record->content);
  if (!chunk || chunk->packed.size != chunk->packed_size) return std::nullopt;
  return McapChunk{index.offset, std::move(*chunk), index.indexes};
}

/// Returns whether the indexes of each chunk are between it and the next one. With shared indexes, a small file could
/// refer to the same messages millions of times.
bool isApart(const std::vector<McapChunk>& chunks, std::uint64_t file_size) {
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    const std::uint64_t end = i + 1 < chunks.size() ? chunks[i + 1].begin : file_size;
    for (const auto& [channel, offset] : chunks[i].indexes)
      if (offset <= chunks[i].begin || offset >= end) return false;
  }
  return true;
}

}  // namespace

std::optional<McapContents> readMcapSummary(ByteView file) {
  const std::optional<ByteView> summary = findSummary(file);
  if (!summary) return std::nullopt;
  McapContents contents;
  contents.is_indexed = true;
  std::optional<mcap::Statistics> statistics;
  std::uint64_t messages = 0;
  mcap::RecordWalk walk(*summary);
  while (const std::optional<mcap::Record> record = walk.next()) {
    if (record->op == Op::Schema) {
      if (auto schema = mcap::parseSchema(record->content)) contents.schemas[schema->id] = std::move(*schema);
    } else if (record->op == Op::Channel) {
      if (auto channel = mcap::parseChannel(record->content)) contents.channels[channel->id] = std::move(*channel);
    } else if (record->op == Op::Statistics) {
      statistics = mcap::parseStatistics(record->content);
    } else if (record->op == Op::ChunkIndex) {
      const std::optional<mcap::ChunkIndex> index = mcap::parseChunkIndex(record->content);
      std::optional<McapChunk> chunk = index ? findChunk(file, *index) : std::nullopt;
      const std::optional<std::uint64_t> count = chunk ? countIndexed(file, *chunk) : std::nullopt;
      if (!count) return std::nullopt;
      messages += *count;
      contents.chunks.push_back(std::move(*chunk));
    }
  }
  // Without statistics, messages outside of chunks would be missed.
  if (!statistics || statistics->messages != messages || statistics->channels != contents.channels.size())
    return std::nullopt;
  for (const McapChunk& chunk : contents.chunks)
    for (const auto& [channel, offset] : chunk.indexes)
      if (contents.channels.count(channel) == 0) return std::nullopt;
  std::sort(contents.chunks.begin(), contents.chunks.end(),
            [](const McapChunk& a, const McapChunk& b) { return a.begin < b.begin; });
  return isApart(contents.chunks, file.size) ? std::optional<McapContents>(std::move(contents)) : std::nullopt;
}

}  // namespace urban_nav_input
