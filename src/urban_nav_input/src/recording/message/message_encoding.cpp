// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/recording/message_encoding.hpp"

#include <cstddef>

namespace urban_nav_input {

std::optional<MessageEncoding> cdrEncoding(ByteView message) {
  constexpr std::size_t kEncapsulation = 4;  // bytes: kind, options
  if (message.size < kEncapsulation || message.data[0] != 0 || message.data[1] > 1) return std::nullopt;
  return message.data[1] == 1 ? MessageEncoding::CdrLittleEndian : MessageEncoding::CdrBigEndian;
}

}  // namespace urban_nav_input
