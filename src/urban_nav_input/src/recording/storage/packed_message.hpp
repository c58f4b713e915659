// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "recording/storage/inflate.hpp"
#include "urban_nav_input/recording/byte_view.hpp"

namespace urban_nav_input {

/// Decompresses messages that rosbag2 compressed one by one (compression_mode MESSAGE). They are recognised by the
/// magic number of zstd, with which no message in CDR begins. Not thread-safe.
class MessageUnpacker {
 public:
  /// Returns the message, valid until the next call and as long as `message`; no data if it is damaged.
  ByteView operator()(ByteView message);

 private:
  Inflated inflated_;
};

/// Returns whether bytes begin with the magic number of zstd.
bool isZstd(ByteView bytes);

}  // namespace urban_nav_input
