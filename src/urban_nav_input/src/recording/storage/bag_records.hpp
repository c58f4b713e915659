// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "urban_nav_input/recording/byte_view.hpp"

namespace urban_nav_input::rosbag1 {

/// Records of the bag format of ROS 1, version 2.0 (wiki.ros.org/Bags/Format/2.0).
enum class Op : std::uint8_t { Message = 2, BagHeader = 3, Index = 4, Chunk = 5, ChunkInfo = 6, Connection = 7 };

constexpr std::string_view kMagic("#ROSBAG V2.0\n");

/// Returns the value of a field of a record's header, or of the data of a Connection; no data if it is absent.
ByteView findField(ByteView fields, std::string_view name);
/// Returns a field that is a little-endian number; nullopt if it is absent or of another size.
template <typename T>
std::optional<T> findNumber(ByteView fields, std::string_view name);
/// Returns a field that is text; empty if it is absent.
std::string findText(ByteView fields, std::string_view name);

struct Record {
  Op op = Op::BagHeader;
  std::uint64_t begin = 0;  ///< position in the bytes
  ByteView header;          ///< fields: length, then "name=value"
  ByteView data;
  std::uint32_t data_size = 0;  ///< stated size; larger than the data if truncated
};

/// Iterates over records. Not thread-safe.
class RecordWalk {
 public:
  explicit RecordWalk(ByteView bytes, std::uint64_t begin = 0) : bytes_(bytes), at_(begin) {}

  /// Returns the next complete record; nullopt at the end, and if the next one is truncated or damaged.
  std::optional<Record> next();
  /// Returns the end of the last record.
  std::uint64_t at() const { return at_; }
  /// Returns the record at this position if it is truncated after its header, with its available data.
  std::optional<Record> cutRecord() const;

 private:
  std::optional<Record> readHead() const;

  ByteView bytes_;
  std::uint64_t at_;
};

}  // namespace urban_nav_input::rosbag1
