// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_input/recording/message_definition.hpp"
#include "urban_nav_input/recording/connection.hpp"

namespace urban_nav_input {

/// Returns the definition of the messages of a connection; for standard types without one in the recording, that of the
/// suite. Throws std::invalid_argument if it is missing or unsupported.
MessageDefinition findDefinition(const Connection& connection);

/// Returns a definition in which the members of standard types have the names of ROS 1 ("K", "header"), which differ
/// from those of ROS 2 in the case of letters. Other types keep theirs.
MessageDefinition withRos1Names(MessageDefinition definition);

}  // namespace urban_nav_input
