// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "recording/message/message_definition.hpp"
#include "urban_nav_input/recording/connection.hpp"

namespace urban_nav_input {

/// Returns the definition of the messages of a connection; that of the suite for standard types where the recording
/// holds none. Throws std::invalid_argument if it is missing or not understood.
MessageDefinition findDefinition(const Connection& connection);

}  // namespace urban_nav_input
