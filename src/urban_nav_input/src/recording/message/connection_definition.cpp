// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/recording/connection_definition.hpp"

#include <strings.h>

#include <algorithm>
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

MessageDefinition withRos1Names(MessageDefinition definition) {
  for (MessageLayout& layout : definition.layouts) {
    const std::optional<KnownType> known = findKnownType(layout.type);
    if (!known) continue;
    const MessageDefinition ros1 = parseDefinition(layout.type, known->definition);
    const std::vector<MessageField>& members = ros1.layouts.front().fields;
    for (MessageField& field : layout.fields) {
      const auto same = std::find_if(members.begin(), members.end(), [&](const MessageField& member) {
        return strcasecmp(member.name.c_str(), field.name.c_str()) == 0;
      });
      if (same != members.end()) field.name = same->name;
    }
  }
  return definition;
}

}  // namespace urban_nav_input
