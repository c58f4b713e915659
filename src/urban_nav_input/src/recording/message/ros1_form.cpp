// SPDX-License-Identifier: BSD-3-Clause
#include "recording/message/ros1_form.hpp"

#include <stdexcept>

#include "urban_nav_input/recording/connection_definition.hpp"
#include "recording/message/known_types.hpp"

namespace urban_nav_input {

Ros1Form::Ros1Form(const Connection& connection) : connection_(connection) {
  if (connection.encoding == "cdr") {
    transcode(connection);
  } else if (connection.encoding == "ros1") {
    if (connection.md5.empty()) connection_.md5 = computeMd5(findDefinition(connection));
  } else {
    throw std::invalid_argument("its messages are encoded as " + connection.encoding);
  }
}

void Ros1Form::transcode(const Connection& connection) {
  const MessageDefinition source = findDefinition(connection);
  if (const std::optional<KnownType> known = findKnownType(connection.type)) {
    try {
      transcoder_.emplace(source, parseDefinition(connection.type, known->definition));
      connection_.md5 = known->md5;
      connection_.definition = known->definition;
      return;
    } catch (const std::invalid_argument&) {
      // Another version of the type, described by the definition in the recording.
    }
  }
  const MessageDefinition ros1 = withSequence(source);
  transcoder_.emplace(source, ros1);
  connection_.definition = printRos1(ros1);
  connection_.md5 = computeMd5(parseDefinition(connection.type, connection_.definition));
}

ByteView Ros1Form::convert(ByteView message) {
  if (!transcoder_) return message;
  const std::optional<MessageEncoding> encoding = cdrEncoding(message);
  if (!encoding) throw std::runtime_error("a message has an unsupported encoding (XCDR2)");
  return transcoder_->convert(message, *encoding, MessageEncoding::Ros1);
}

}  // namespace urban_nav_input
