// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <cstddef>
#include <exception>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_input/recording/receipt_range.hpp"
#include "urban_nav_ros/extrinsics.hpp"

namespace urban_nav_input {

/// Returns whether a file begins as a ROS 1 bag does.
bool isBagFile(const std::string& path);

/// Throws the DataError of a file that cannot be read on, with what was found.
[[noreturn]] void throwDamaged(const std::string& path, const std::exception& found);

/// A message of a recording, valid as long as the RecordedMessages that returned it.
class RecordedMessage {
 public:
  /// `path`: the file that holds the message; outlives this object.
  RecordedMessage(rosbag::MessageInstance instance, const std::string& path)
      : instance_(std::move(instance)), path_(&path) {}

  const std::string& topic() const { return instance_.getTopic(); }
  /// Returns the time at which the recorder received the message, ns.
  urban_nav_core::StampNs receipt() const;
  /// Returns the message; null if it is of another type. Throws DataError if its bytes are damaged.
  template <typename Message>
  boost::shared_ptr<Message> as() const {
    try {
      return instance_.instantiate<Message>();
    } catch (const std::exception& error) {
      throwDamaged(*path_, error);
    }
  }

 private:
  rosbag::MessageInstance instance_;
  const std::string* path_;
};

class Recording;

/// The messages of some topics of a recording, file after file, within a file in the order of receipt. Not thread-safe.
class RecordedMessages {
 public:
  /// The recording outlives this object.
  RecordedMessages(Recording& recording, const std::vector<std::string>& topics, const ReceiptRange& range);

  /// Returns the next message; nullopt at the end. Throws DataError if the recording cannot be read on.
  std::optional<RecordedMessage> next();
  /// Returns the number of messages, whether returned already or not.
  std::size_t size() const { return size_; }

 private:
  struct File {
    const std::string* path;
    rosbag::View view;
  };
  std::list<File> files_;
  std::list<File>::iterator file_;
  rosbag::View::iterator position_;
  std::size_t size_ = 0;
};

/// The files of a recording, open for reading. The only way to messages for code outside of this package. Not
/// thread-safe.
class Recording {
 public:
  /// Throws UserError for a file that is not a recording, DataError for one that cannot be read.
  explicit Recording(const std::vector<std::string>& paths);
  explicit Recording(const std::string& path) : Recording(std::vector<std::string>{path}) {}

  const std::vector<std::string>& paths() const { return paths_; }
  /// Returns the type of every topic, "sensor_msgs/Image", by name.
  std::map<std::string, std::string> topicTypes();
  /// Returns the transforms of /tf_static, and those of /tf that stay the same throughout.
  urban_nav_ros::StaticTransforms transforms();
  /// Returns the receipt of the first message, ns; 0 for a recording without messages.
  urban_nav_core::StampNs begin();
  /// Returns the messages on topics with these exact names that were received within a range.
  RecordedMessages messages(const std::vector<std::string>& topics, const ReceiptRange& range = {});
  /// Returns the first message of a topic that is of type Message; null if there is none.
  template <typename Message>
  boost::shared_ptr<Message> first(const std::string& topic) {
    RecordedMessages all = messages({topic});
    while (const std::optional<RecordedMessage> each = all.next())
      if (boost::shared_ptr<Message> message = each->as<Message>()) return message;
    return nullptr;
  }

  /// Returns the files, for the readers of this package.
  std::list<rosbag::Bag>& bags() { return bags_; }

 private:
  std::vector<std::string> paths_;
  std::list<rosbag::Bag> bags_;
};

}  // namespace urban_nav_input
