// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <list>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "recording/message/transcoder.hpp"
#include "recording/storage/storage.hpp"
#include "urban_nav_input/recording/recorded_message.hpp"

namespace urban_nav_input {

/// A file of a recording, or a folder that is one.
class RecordingFile {
 public:
  explicit RecordingFile(std::string path) : path_(std::move(path)), storage_(openStorage(path_)) {}

  const std::string& path() const { return path_; }
  Storage& storage() { return *storage_; }

  /// Decoding of messages of a connection in CDR as those of a ROS 1 type.
  struct Decoder {
    const char* definition;                ///< definition of the type, whose address identifies it
    bool is_readable = false;              ///< the types are the same
    std::optional<Transcoder> transcoder;  ///< if their members differ
  };
  Decoder& decoder(std::size_t connection, const RecordedMessage::Type& type);

 private:
  std::string path_;
  std::unique_ptr<Storage> storage_;
  std::vector<std::list<Decoder>> decoders_;  // index: connection
};

}  // namespace urban_nav_input
