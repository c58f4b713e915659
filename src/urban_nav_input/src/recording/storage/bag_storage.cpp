// SPDX-License-Identifier: BSD-3-Clause
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <boost/make_unique.hpp>
#include <fstream>
#include <utility>

#include "recording/storage/bag_records.hpp"
#include "recording/storage/byte_reader.hpp"
#include "recording/storage/mapped_file.hpp"
#include "recording/storage/storage.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/recording/recording.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_input {

namespace {

/// Growing buffer for a message of librosbag, without zero-initialisation.
class MessageBuffer {
 public:
  std::uint8_t* advance(std::uint32_t size) {
    if (size > capacity_) {
      bytes_ = boost::make_unique_noinit<std::uint8_t[]>(size);
      capacity_ = size;
    }
    size_ = size;
    return bytes_.get();
  }
  void clear() { size_ = 0; }
  ByteView view() {
    if (!bytes_) advance(1), clear();
    return {bytes_.get(), size_};
  }

 private:
  std::unique_ptr<std::uint8_t[]> bytes_;
  std::uint32_t size_ = 0, capacity_ = 0;
};

/// ROS 1 bag of version 1.2, read by librosbag.
class BagStorage : public Storage {
 public:
  /// Throws the exceptions of librosbag.
  explicit BagStorage(std::string path) : path_(std::move(path)) {
    bag_.open(path_, rosbag::bagmode::Read);
    for (const rosbag::ConnectionInfo* info : rosbag::View(bag_).getConnections()) addConnection(*info);
  }

  const char* kind() const override { return "bag"; }
  std::string description() const override { return "a ROS 1 bag"; }
  const std::vector<Connection>& connections() const override { return connections_; }

  const std::vector<MessageEntry>& index(std::size_t connection) override {
    Index& index = indexes_[connection];
    if (index.is_read) return index.entries;
    index.is_read = true;
    try {
      const std::uint32_t id = index.id;
      rosbag::View view(bag_, [id](const rosbag::ConnectionInfo* info) { return info->id == id; });
      index.entries.reserve(view.size());
      index.instances.reserve(view.size());
      for (const rosbag::MessageInstance& instance : view) {
        index.entries.push_back({urban_nav_ros::toStampNs(instance.getTime()), index.instances.size()});
        index.instances.push_back(instance);
      }
    } catch (const std::exception& error) {
      throwDamaged(path_, error);
    }
    return index.entries;
  }

  ByteView read(std::size_t connection, const MessageEntry& entry) override {
    try {
      buffer_.clear();
      indexes_[connection].instances[entry.place].write(buffer_);
      return buffer_.view();
    } catch (const std::exception& error) {
      if (damaged_++ == 0) fault_ = error.what();
      return {};
    }
  }

  std::vector<std::string> warnings() const override {
    if (damaged_ == 0) return {};
    return {std::to_string(damaged_) + (damaged_ == 1 ? " message cannot" : " messages cannot") +
            " be read and are left out: " + fault_};
  }

 private:
  struct Index {
    std::uint32_t id = 0;  // id of the connection in the bag
    bool is_read = false;
    std::vector<MessageEntry> entries;
    std::vector<rosbag::MessageInstance> instances;
  };

  void addConnection(const rosbag::ConnectionInfo& info) {
    Connection connection;
    connection.topic = info.topic;
    connection.type = info.datatype;
    connection.md5 = info.md5sum;
    connection.definition = info.msg_def;
    connection.definition_encoding = "ros1msg";
    connection.encoding = "ros1";
    const auto header = [&](const char* key) {
      const auto found = info.header->find(key);
      return found == info.header->end() ? std::string() : found->second;
    };
    connection.caller_id = header("callerid");
    connection.is_latched = header("latching") == "1";
    connections_.push_back(std::move(connection));
    indexes_.emplace_back().id = info.id;
  }

  std::string path_;
  rosbag::Bag bag_;
  std::vector<Connection> connections_;
  std::vector<Index> indexes_;  // index: connection
  MessageBuffer buffer_;
  std::uint64_t damaged_ = 0;  // messages that could not be read
  std::string fault_;          // of the first of them
};

/// Returns whether the version of a bag is 2.0, whose records are read without librosbag.
bool hasBagRecords(const std::string& path) {
  std::string begin(rosbag1::kMagic.size(), '\0');
  std::ifstream(path, std::ios::binary).read(begin.data(), static_cast<std::streamsize>(begin.size()));
  return begin == rosbag1::kMagic;
}

/// Throws DataError if the records of a bag do not fill it, since librosbag ends the process for a length that it
/// cannot allocate.
void checkLengths(const std::string& path) {
  const MappedFile file(path);
  const ByteView bytes = file.bytes();
  std::size_t line = 0;
  while (line < bytes.size && bytes.data[line] != '\n') ++line;
  ByteReader reader({bytes.data + line, bytes.size - line});
  reader.bytes(1);
  while (reader.isGood() && reader.left() > 0) {
    reader.bytes(reader.number<std::uint32_t>());  // fields
    reader.bytes(reader.number<std::uint32_t>());  // data
  }
  if (!reader.isGood())
    throw urban_nav_core::DataError(path, "is a bag of version 1 that is truncated or damaged", "an intact bag");
}

}  // namespace

std::unique_ptr<Storage> openBagStorage(const std::string& path) {
  if (hasBagRecords(path)) return openBagRecords(path);
  checkLengths(path);
  try {
    return std::make_unique<BagStorage>(path);
  } catch (const std::exception& error) {
    throwDamaged(path, error);
  }
}

}  // namespace urban_nav_input
