// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <stdexcept>
#include <utility>

#include "recording/storage/byte_reader.hpp"
#include "recording/storage/mapped_file.hpp"
#include "recording/storage/mcap_chunk_cache.hpp"
#include "recording/storage/mcap_contents.hpp"
#include "recording/storage/storage.hpp"
#include "urban_nav_input/recording/message_definition.hpp"

namespace urban_nav_input {

namespace {

/// MCAP file. With an index, decompresses only the chunks of requested messages.
class McapStorage : public Storage {
 public:
  explicit McapStorage(const std::string& path)
      : file_(path), contents_(readMcapContents(path, file_.bytes())), cache_(contents_.chunks) {
    for (const auto& [id, channel] : contents_.channels) addConnection(channel);
    indexes_.resize(connections_.size());
  }

  const char* kind() const override { return "mcap"; }
  std::string description() const override {
    const std::optional<mcap::Record> header = mcap::RecordWalk(file_.bytes(), mcap::kMagic.size()).next();
    const std::string profile = header ? mcap::parseProfile(*header) : "";
    if (profile == "ros1" || profile == "ros2") return "MCAP of ROS " + profile.substr(3);
    return profile.empty() ? "MCAP" : "MCAP of profile " + profile;
  }
  const std::vector<Connection>& connections() const override { return connections_; }

  const std::vector<MessageEntry>& index(std::size_t connection) override {
    Index& index = indexes_[connection];
    if (index.is_read) return index.entries;
    index.is_read = true;
    if (contents_.is_indexed) index.entries = readIndex(channels_[connection]);
    else index.entries = std::move(contents_.entries[channels_[connection]]);
    if (!std::is_sorted(index.entries.begin(), index.entries.end()))
      std::sort(index.entries.begin(), index.entries.end());
    return index.entries;
  }

  ByteView read(std::size_t connection, const MessageEntry& entry) override {
    const std::uint64_t chunk = placedChunk(entry.place);
    if (chunk != kNoChunk && chunk >= contents_.chunks.size()) {
      ++misplaced_;
      return {};
    }
    const ByteView records = chunk == kNoChunk ? file_.bytes() : cache_.records(static_cast<std::size_t>(chunk));
    if (records.data == nullptr) return {};
    const std::optional<mcap::Record> record = mcap::RecordWalk(records, placedOffset(entry.place)).next();
    const std::optional<mcap::Message> message =
        record && record->op == mcap::Op::Message ? mcap::parseMessage(record->content) : std::nullopt;
    if (message && message->channel == channels_[connection]) {
      file_.countRead(message->data.size);
      return message->data;
    }
    ++misplaced_;
    return {};
  }

  std::uint64_t chunksInflated() const override { return cache_.inflated(); }

  std::vector<std::string> warnings() const override {
    std::vector<std::string> all = contents_.warnings;
    all.insert(all.end(), cache_.warnings().begin(), cache_.warnings().end());
    if (misplaced_ > 0)
      all.push_back("its index is wrong: " + std::to_string(misplaced_) +
                    (misplaced_ == 1 ? " message was not found" : " messages were not found"));
    return all;
  }

 private:
  struct Index {
    bool is_read = false;
    std::vector<MessageEntry> entries;
  };

  void addConnection(const mcap::Channel& channel) {
    Connection connection;
    connection.topic = channel.topic;
    connection.encoding = channel.encoding;
    if (const auto schema = contents_.schemas.find(channel.schema); schema != contents_.schemas.end()) {
      connection.type = toRos1Type(schema->second.name);
      connection.definition = schema->second.text;
      connection.definition_encoding = schema->second.encoding;
    }
    const auto metadata = [&](const char* key) {
      const auto found = channel.metadata.find(key);
      return found == channel.metadata.end() ? std::string() : found->second;
    };
    connection.caller_id = metadata("callerid");
    connection.is_latched = metadata("latching") == "1";
    if (connection.encoding == "ros1") {
      try {
        connection.md5 = computeMd5(parseDefinition(connection.type, connection.definition));
      } catch (const std::invalid_argument&) {
        connection.md5 = metadata("md5sum");
      }
    }
    connections_.push_back(std::move(connection));
    channels_.push_back(channel.id);
  }

  std::vector<MessageEntry> readIndex(std::uint16_t channel) const {
    std::vector<MessageEntry> entries;
    for (std::size_t chunk = 0; chunk < contents_.chunks.size(); ++chunk) {
      const auto& indexes = contents_.chunks[chunk].indexes;
      const auto place = indexes.find(channel);
      if (place == indexes.end()) continue;
      const std::optional<mcap::Record> record = mcap::RecordWalk(file_.bytes(), place->second).next();
      ByteReader reader(mcap::parseMessageIndex(record->content)->entries);
      while (reader.left() >= mcap::kIndexEntry) {
        const auto time = static_cast<urban_nav_core::StampNs>(reader.number<std::uint64_t>());
        entries.push_back({time, makePlace(chunk, reader.number<std::uint64_t>())});
      }
    }
    return entries;
  }

  MappedFile file_;
  McapContents contents_;
  McapChunkCache cache_;
  std::vector<Connection> connections_;
  std::vector<std::uint16_t> channels_;  // index: connection
  std::vector<Index> indexes_;           // index: connection
  std::uint64_t misplaced_ = 0;
};

}  // namespace

std::unique_ptr<Storage> openMcapStorage(const std::string& path) { return std::make_unique<McapStorage>(path); }

}  // namespace urban_nav_input
