// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_input/recording/receipt_range.hpp"
#include "urban_nav_input/recording/recorded_message.hpp"

namespace urban_nav_input {

/// Messages of some files of a recording in the order of receipt; those of equal receipt in the order of the names of
/// their topics, then of the files, then of the file. The order depends only on the messages, so it is the same in
/// every storage. Not thread-safe.
class MessageSelection {
 public:
  /// Selects messages on topics with these exact names, or on all topics for nullopt, that were received within a
  /// range. The files must outlive this object.
  MessageSelection(const std::vector<RecordingFile*>& files, const std::optional<std::vector<std::string>>& topics,
                   const ReceiptRange& range);

  /// Returns the number of messages, whether returned already or not.
  std::size_t size() const { return size_; }
  /// Returns the receipt of the first message, ns; 0 without messages.
  urban_nav_core::StampNs first() const { return first_; }
  /// Returns the receipt of the last message, ns; 0 without messages.
  urban_nav_core::StampNs last() const { return last_; }
  /// Returns the next message; nullopt at the end.
  std::optional<RecordedMessage> next();
  /// Restarts with the first message.
  void rewind();

 private:
  /// Remaining messages of one connection.
  struct Cursor {
    RecordingFile* file;
    std::size_t connection;
    std::size_t rank;  // among messages of equal receipt
    const MessageEntry* at;
    const MessageEntry* end;
  };
  static bool isLater(const Cursor& a, const Cursor& b);

  std::vector<Cursor> all_;   // initial cursors, by rank
  std::vector<Cursor> heap_;  // the first element has the next message
  std::size_t size_ = 0;
  urban_nav_core::StampNs first_ = 0, last_ = 0;
};

}  // namespace urban_nav_input
