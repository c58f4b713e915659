// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/message_traits.h>

#include <boost/make_shared.hpp>
#include <cstddef>
#include <exception>
#include <optional>
#include <string>

#include "urban_nav_core/types/error.hpp"
#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_input/recording/byte_view.hpp"
#include "urban_nav_input/recording/connection.hpp"
#include "urban_nav_input/recording/message_entry.hpp"
#include "urban_nav_input/recording/message_stream.hpp"

namespace urban_nav_input {

class RecordingFile;

/// Throws the DataError for a file that has become unreadable, with the cause.
[[noreturn]] void throwDamaged(const std::string& path, const std::exception& found);

/// A message of a recording, read on access. Valid as long as the Recording.
class RecordedMessage {
 public:
  RecordedMessage(RecordingFile& file, std::size_t connection, const MessageEntry& entry)
      : file_(&file), connection_(connection), entry_(entry) {}

  const Connection& connection() const;
  const std::string& topic() const { return connection().topic; }
  /// Returns the file that holds the message.
  const std::string& path() const;
  /// Returns the time at which the recorder received the message, ns.
  urban_nav_core::StampNs receipt() const { return entry_.receipt; }
  /// Returns the encoded message, valid until another one of the recording is read; no data if it is damaged.
  ByteView bytes() const;
  /// Returns the message; null if it is of another type, or unreadable, which the storage counts. Throws DataError if
  /// its bytes are damaged.
  template <typename Message>
  boost::shared_ptr<Message> as() const {
    namespace traits = ros::message_traits;
    try {
      const std::optional<Encoded> encoded = encodedAs(
          {traits::DataType<Message>::value(), traits::MD5Sum<Message>::value(), traits::Definition<Message>::value()});
      if (!encoded) return nullptr;
      auto message = boost::make_shared<Message>();
      MessageStream stream(encoded->bytes, encoded->encoding);
      stream.next(*message);
      return message;
    } catch (const urban_nav_core::Error&) {
      throw;
    } catch (const std::exception& error) {
      throwDamaged(path(), error);
    }
  }

  /// Type of ROS 1 messages.
  struct Type {
    const char* name;
    const char* md5;
    const char* definition;
  };

 private:
  /// Bytes with their encoding.
  struct Encoded {
    ByteView bytes;
    MessageEncoding encoding;
  };
  /// Returns the bytes of a message of a type; nullopt if it is of another type, or unreadable.
  std::optional<Encoded> encodedAs(const Type& type) const;

  RecordingFile* file_;
  std::size_t connection_;
  MessageEntry entry_;
};

}  // namespace urban_nav_input
