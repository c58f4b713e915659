// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "urban_nav_input/recording/byte_view.hpp"

namespace urban_nav_input {

/// Serialization of a message.
enum class MessageEncoding {
  Ros1,             ///< packed, little endian
  CdrLittleEndian,  ///< OMG CDR (XCDR1): members aligned to their size after an encapsulation header of 4 bytes
  CdrBigEndian
};

/// Returns the encoding of a message by its encapsulation header; nullopt if it is XCDR2 or a
/// parameter list.
std::optional<MessageEncoding> cdrEncoding(ByteView message);

}  // namespace urban_nav_input
