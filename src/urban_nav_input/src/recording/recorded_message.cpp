// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/recording/recorded_message.hpp"

#include <filesystem>

#include "recording/recording_file.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_input {

void throwDamaged(const std::string& path, const std::exception& found) {
  const bool is_bag = std::filesystem::path(path).extension() == ".bag";
  throw urban_nav_core::DataError(
      path, std::string("cannot be read: ") + found.what(),
      is_bag ? "an intact recording (`rosbag reindex` repairs a truncated bag)" : "an intact recording");
}

const Connection& RecordedMessage::connection() const { return file_->storage().connections()[connection_]; }

ByteView RecordedMessage::bytes() const { return file_->storage().read(connection_, entry_); }

const std::string& RecordedMessage::path() const { return file_->path(); }

std::optional<RecordedMessage::Encoded> RecordedMessage::encodedAs(const Type& type) const {
  const Connection& source = connection();
  if (source.encoding == "ros1") {
    if (source.md5 != type.md5) return std::nullopt;
    const ByteView packed = bytes();
    return packed.data == nullptr ? std::nullopt : std::optional<Encoded>({packed, MessageEncoding::Ros1});
  }
  if (source.encoding != "cdr" || source.type != type.name) return std::nullopt;
  RecordingFile::Decoder& decoder = file_->decoder(connection_, type);
  const ByteView encoded = bytes();
  const std::optional<MessageEncoding> encoding = cdrEncoding(encoded);
  if (!decoder.is_readable || !encoding) return std::nullopt;
  if (!decoder.transcoder) return Encoded{encoded, *encoding};
  return Encoded{decoder.transcoder->convert(encoded, *encoding, MessageEncoding::Ros1), MessageEncoding::Ros1};
}

}  // namespace urban_nav_input
