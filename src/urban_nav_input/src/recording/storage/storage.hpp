// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_input/recording/byte_view.hpp"
#include "urban_nav_input/recording/connection.hpp"
#include "urban_nav_input/recording/message_entry.hpp"

namespace urban_nav_input {

/// One file or folder of a recording, open for reading, with access to its connections and to messages in any order.
/// Memory: an entry for each message of the requested connections, and the chunks in use. Not thread-safe.
class Storage {
 public:
  Storage() = default;
  Storage(const Storage&) = delete;
  Storage& operator=(const Storage&) = delete;
  virtual ~Storage() = default;

  /// Returns the kind of storage: "bag", "mcap", "db3", "rosbag2".
  virtual const char* kind() const = 0;
  /// Returns a description of the file for the user: "a ROS 1 bag", "MCAP, profile ros1".
  virtual std::string description() const { return kind(); }
  /// Returns the connections in the order of the file.
  virtual const std::vector<Connection>& connections() const = 0;
  /// Returns the messages of a connection by receipt, then by position in the file.
  virtual const std::vector<MessageEntry>& index(std::size_t connection) = 0;
  /// Returns the encoded bytes of a message, valid until the next call; no data if they are damaged, which is reported
  /// by warnings(). Throws DataError if the file becomes unreadable.
  virtual ByteView read(std::size_t connection, const MessageEntry& entry) = 0;
  /// Returns the number of decompressions of chunks.
  virtual std::uint64_t chunksInflated() const { return 0; }
  /// Returns the defects found so far, with their positions.
  virtual std::vector<std::string> warnings() const { return {}; }
};

/// Opens a recording, whose kind is determined by its content. Throws UserError for a file that is not a recording or
/// of an unsupported kind; DataError for an unreadable one.
std::unique_ptr<Storage> openStorage(const std::string& path);

std::unique_ptr<Storage> openBagStorage(const std::string& path);
/// Opens a bag by its index, or without it if it is inconsistent. Throws like openScannedBag(). Requires the magic
/// bytes of version 2.0.
std::unique_ptr<Storage> openBagRecords(const std::string& path);
/// Opens a bag without its index: a truncated, damaged or unfinished one. Throws DataError if no message is intact.
std::unique_ptr<Storage> openScannedBag(const std::string& path);
std::unique_ptr<Storage> openMcapStorage(const std::string& path);
std::unique_ptr<Storage> openDb3Storage(const std::string& path);
std::unique_ptr<Storage> openRosbag2Folder(const std::string& path);
/// Opens a recording compressed by zstd, through a temporary file.
std::unique_ptr<Storage> openUnpackedStorage(const std::string& path);

/// Returns whether an SQLite database has the tables of rosbag2.
bool isDb3(const std::string& path);

}  // namespace urban_nav_input
