// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_input/recording/connection.hpp"
#include "urban_nav_input/recording/message_selection.hpp"
#include "urban_nav_input/recording/receipt_range.hpp"
#include "urban_nav_input/recording/recorded_message.hpp"
#include "urban_nav_ros/extrinsics.hpp"

namespace urban_nav_input {

/// Returns whether a path is a recording by its content: a ROS 1 bag or an MCAP file.
bool isRecording(const std::string& path);

/// The messages of some topics of a recording, file after file, within a file in the order of receipt. Not thread-safe.
class RecordedMessages {
 public:
  explicit RecordedMessages(std::list<MessageSelection> files);

  /// Returns the next message; nullopt at the end. Throws DataError if the recording becomes unreadable.
  std::optional<RecordedMessage> next();
  /// Returns the number of messages, whether returned already or not.
  std::size_t size() const { return size_; }

 private:
  std::list<MessageSelection> files_;
  std::size_t size_ = 0;
};

/// The files of a recording in any storage, open for reading. Code outside of recording/ accesses messages only through
/// this class. Not thread-safe.
class Recording {
 public:
  /// Throws UserError for a file that is not a recording, DataError for one that cannot be read.
  explicit Recording(const std::vector<std::string>& paths);
  explicit Recording(const std::string& path) : Recording(std::vector<std::string>{path}) {}
  Recording(Recording&& other) noexcept;
  ~Recording();

  const std::vector<std::string>& paths() const { return paths_; }
  /// Returns the kind of storage of the first file: "bag", "mcap".
  std::string kind() const;
  /// Returns a description of the first file for the user: "a ROS 1 bag", "MCAP of ROS 2".
  std::string description() const;
  /// Returns the type of every topic, "sensor_msgs/Image", by name.
  std::map<std::string, std::string> topicTypes() const;
  /// Returns the connections of all files, in their order.
  std::vector<Connection> connections() const;
  /// Returns the reason why messages of a topic cannot be decoded: their encoding, or a missing or unsupported
  /// definition; empty if they can. Reads the first message, of type `type` if given.
  std::string undecoded(const std::string& topic, const std::string& type = {});
  /// Returns the number of messages on a topic.
  std::size_t count(const std::string& topic);
  /// Returns the transforms of /tf_static, and the constant ones of /tf.
  urban_nav_ros::StaticTransforms transforms();
  /// Returns the receipt of the first message, ns; 0 for a recording without messages.
  urban_nav_core::StampNs begin();
  /// Returns the receipt of the last message, ns; 0 for a recording without messages.
  urban_nav_core::StampNs end();
  /// Returns the messages on topics with these exact names that were received within a range.
  RecordedMessages messages(const std::vector<std::string>& topics, const ReceiptRange& range = {});
  /// Returns the messages on topics with these exact names, or on all topics for nullopt, that were received within a
  /// range, of all files in the order of receipt.
  MessageSelection select(const std::optional<std::vector<std::string>>& topics, const ReceiptRange& range = {});
  /// Returns the first message of a topic that is of type Message; null if there is none.
  template <typename Message>
  boost::shared_ptr<Message> first(const std::string& topic) {
    RecordedMessages all = messages({topic});
    while (const std::optional<RecordedMessage> each = all.next())
      if (boost::shared_ptr<Message> message = each->as<Message>()) return message;
    return nullptr;
  }
  /// Returns the defects of the files found so far, each with the name of its file.
  std::vector<std::string> warnings() const;

  /// Returns the files in their order; valid as long as the recording.
  std::vector<RecordingFile*> files() const;

 private:
  std::vector<std::string> paths_;
  std::vector<std::unique_ptr<RecordingFile>> files_;
};

}  // namespace urban_nav_input
