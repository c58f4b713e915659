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

/// One file or folder of a recording, open for reading: what is in it by connection, and its messages in any order.
/// Memory: an entry for each message of the connections that were asked for, and the chunks in use. Not thread-safe.
class Storage {
 public:
  Storage() = default;
  Storage(const Storage&) = delete;
  Storage& operator=(const Storage&) = delete;
  virtual ~Storage() = default;

  /// Returns the kind of storage: "bag", "mcap", "db3", "rosbag2".
  virtual const char* kind() const = 0;
  /// Returns what the file is, for messages: "a ROS 1 bag", "MCAP, profile ros1".
  virtual std::string description() const { return kind(); }
  /// Returns the connections in the order of the file.
  virtual const std::vector<Connection>& connections() const = 0;
  /// Returns the messages of a connection by receipt, those of equal receipt as they lie in the file.
  virtual const std::vector<MessageEntry>& index(std::size_t connection) = 0;
  /// Returns the bytes of a message as they are encoded, valid until the next call; no data if they are damaged, which
  /// is counted in warnings(). Throws DataError if the file cannot be read on.
  virtual ByteView read(std::size_t connection, const MessageEntry& entry) = 0;
  /// Returns how often a chunk was decompressed to read messages.
  virtual std::uint64_t chunksInflated() const { return 0; }
  /// Returns what is missing or damaged, and where, as far as it was met.
  virtual std::vector<std::string> warnings() const { return {}; }
};

/// Opens a recording, whose kind is recognised by its content. Throws UserError for what is no recording, or of a kind
/// that is not understood; DataError for one that cannot be read.
std::unique_ptr<Storage> openStorage(const std::string& path);

std::unique_ptr<Storage> openBagStorage(const std::string& path);
/// Opens a bag by its index, or without it where it is not consistent. Throws like openScannedBag(). Requires that the
/// file begins as bags of version 2.0 do.
std::unique_ptr<Storage> openBagRecords(const std::string& path);
/// Opens a bag without its index: one that was cut off, is damaged, or that its recorder did not finish. Throws
/// DataError if no message is whole.
std::unique_ptr<Storage> openScannedBag(const std::string& path);
std::unique_ptr<Storage> openMcapStorage(const std::string& path);
std::unique_ptr<Storage> openDb3Storage(const std::string& path);
std::unique_ptr<Storage> openRosbag2Folder(const std::string& path);
/// Opens a file that zstd compressed, from a temporary file.
std::unique_ptr<Storage> openUnpackedStorage(const std::string& path);

/// Returns whether an SQLite database has the tables of rosbag2.
bool isDb3(const std::string& path);

}  // namespace urban_nav_input
