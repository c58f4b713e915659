// SPDX-License-Identifier: BSD-3-Clause
#include "recording/message/connection_definition.hpp"

#include <stdexcept>

#include "recording/message/known_types.hpp"

namespace urban_nav_input {

MessageDefinition findDefinition(const Connection& connection) {
  if (!connection.definition.empty()) {
    if (connection.definition_encoding != "ros1msg" && connection.definition_encoding != "ros2msg")
      throw std::invalid_argument("the definition of " + connection.type + " is in " + connection.definition_encoding);
    return parseDefinition(connection.type, connection.definition);
  }
  const std::optional<KnownType> known = findKnownType(connection.type);
  if (!known) throw std::invalid_argument("the recording does not hold the definition of " + connection.type);
  const MessageDefinition definition = parseDefinition(connection.type, known->definition);
  return connection.encoding == "ros1" ? definition : withoutSequence(definition);
}

}  // namespace urban_nav_input
