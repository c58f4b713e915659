// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

#include "recording/storage/packed_message.hpp"
#include "recording/storage/sqlite_file.hpp"
#include "recording/storage/storage.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/recording/message_definition.hpp"

namespace urban_nav_input {

using urban_nav_core::DataError;

namespace {

constexpr std::int64_t kNewestSchema = 4;  // that of Jazzy

/// Database of rosbag2: tables topics and messages, and since Iron message_definitions and schema.
class Db3Storage : public Storage {
 public:
  explicit Db3Storage(const std::string& path) : file_(path) {
    const std::map<std::string, Definition> definitions = readDefinitions();
    SqliteFile::Query topics(file_, "SELECT id, name, type, serialization_format FROM topics ORDER BY id");
    while (topics.next()) {
      Connection connection;
      connection.topic = topics.text(1);
      connection.type = toRos1Type(topics.text(2));
      connection.encoding = topics.text(3);
      if (const auto found = definitions.find(connection.type); found != definitions.end()) {
        connection.definition = found->second.text;
        connection.definition_encoding = found->second.encoding;
      }
      places_[topics.integer(0)] = connections_.size();
      connections_.push_back(std::move(connection));
    }
    indexes_.resize(connections_.size());
    checkVersion();
    if (std::string cut = file_.cut(); !cut.empty()) warnings_.push_back(std::move(cut));
    if (file_.isWalIgnored()) warnings_.push_back("has a -wal that cannot be read: messages in it are missing");
    readIndex();
    read_.emplace(file_, "SELECT data FROM messages WHERE rowid = ?");
  }

  const char* kind() const override { return "db3"; }
  std::string description() const override { return "a .db3 of rosbag2"; }
  const std::vector<Connection>& connections() const override { return connections_; }
  const std::vector<MessageEntry>& index(std::size_t connection) override { return indexes_[connection]; }

  ByteView read(std::size_t, const MessageEntry& entry) override {
    try {
      read_->reset();
      read_->bind(1, static_cast<std::int64_t>(entry.place));
      if (read_->next())
        if (const ByteView message = unpack_(read_->blob(0)); message.data != nullptr) return message;
    } catch (const DataError&) {
      // Counted below: a damaged page does not affect messages on other pages.
    }
    ++damaged_;
    return {};
  }

  std::vector<std::string> warnings() const override {
    std::vector<std::string> all = warnings_;
    if (damaged_ > 0)
      all.push_back(std::to_string(damaged_) +
                    (damaged_ == 1 ? " message is damaged and is left out" : " messages are damaged and are left out"));
    return all;
  }

 private:
  struct Definition {
    std::string encoding, text;
  };

  /// Returns the definitions by type.
  std::map<std::string, Definition> readDefinitions() {
    std::map<std::string, Definition> definitions;
    if (!file_.hasTable("message_definitions")) return definitions;
    SqliteFile::Query rows(file_, "SELECT topic_type, encoding, encoded_message_definition FROM message_definitions");
    while (rows.next())
      if (std::string text = rows.text(2); !text.empty())
        definitions[toRos1Type(rows.text(0))] = {rows.text(1), std::move(text)};
    return definitions;
  }

  void checkVersion() {
    if (!file_.hasTable("schema")) return;
    SqliteFile::Query rows(file_, "SELECT max(schema_version) FROM schema");
    if (rows.next() && rows.integer(0) > kNewestSchema)
      warnings_.push_back("is of schema " + std::to_string(rows.integer(0)) + ", which is newer than " +
                          std::to_string(kNewestSchema) + ": read as the newest known schema");
  }

  /// Reads rows in the order of the file, without an SQLite index and without reading messages.
  void readIndex() {
    std::uint64_t orphans = 0, read = 0;
    try {
      SqliteFile::Query rows(file_, "SELECT rowid, topic_id, timestamp FROM messages NOT INDEXED");
      while (rows.next()) {
        ++read;
        const auto place = places_.find(rows.integer(1));
        if (place == places_.end()) ++orphans;
        else indexes_[place->second].push_back({rows.integer(2), static_cast<std::uint64_t>(rows.integer(0))});
      }
    } catch (const DataError& error) {
      if (read == 0) throw;
      warnings_.push_back("is cut off or damaged (" + error.parts().found + "): the " + std::to_string(read) +
                          " messages before are used");
    }
    if (orphans > 0) warnings_.push_back(std::to_string(orphans) + " messages belong to no topic and are left out");
    for (std::vector<MessageEntry>& index : indexes_)
      if (!std::is_sorted(index.begin(), index.end())) std::sort(index.begin(), index.end());
  }

  SqliteFile file_;
  std::vector<Connection> connections_;
  std::map<std::int64_t, std::size_t> places_;  // connections by the id of their topic
  std::vector<std::vector<MessageEntry>> indexes_;
  std::optional<SqliteFile::Query> read_;
  MessageUnpacker unpack_;
  std::vector<std::string> warnings_;
  std::uint64_t damaged_ = 0;
};

}  // namespace

bool isDb3(const std::string& path) {
  try {
    SqliteFile file(path);
    return file.hasTable("topics") && file.hasTable("messages");
  } catch (const DataError&) {
    return false;
  }
}

std::unique_ptr<Storage> openDb3Storage(const std::string& path) { return std::make_unique<Db3Storage>(path); }

}  // namespace urban_nav_input
