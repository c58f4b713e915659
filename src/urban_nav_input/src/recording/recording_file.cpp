// SPDX-License-Identifier: BSD-3-Clause
#include "recording/recording_file.hpp"

#include <stdexcept>

#include "urban_nav_core/types/error.hpp"

namespace urban_nav_input {

RecordingFile::Decoder& RecordingFile::decoder(std::size_t connection, const RecordedMessage::Type& type) {
  if (decoders_.empty()) decoders_.resize(storage_->connections().size());
  std::list<Decoder>& known = decoders_[connection];
  for (Decoder& decoder : known)
    if (decoder.definition == type.definition) return decoder;
  Decoder& decoder = known.emplace_back(Decoder{type.definition, false, std::nullopt});
  const Connection& source = storage_->connections()[connection];
  decoder.is_readable = source.type == type.name;
  // Older storages have no definitions: uses that of the type.
  if (!decoder.is_readable || source.definition.empty()) return decoder;
  try {
    Transcoder transcoder(parseDefinition(source.type, source.definition), parseDefinition(type.name, type.definition));
    if (!transcoder.isSame()) decoder.transcoder = std::move(transcoder);
  } catch (const std::invalid_argument& error) {
    throw urban_nav_core::DataError(path_ + ", topic " + source.topic,
                                    "cannot be decoded as " + source.type + ": " + error.what(), "");
  }
  return decoder;
}

}  // namespace urban_nav_input
