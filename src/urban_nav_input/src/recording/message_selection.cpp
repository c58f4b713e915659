// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/recording/message_selection.hpp"

#include <algorithm>
#include <tuple>

#include "recording/recording_file.hpp"

namespace urban_nav_input {

using urban_nav_core::StampNs;

MessageSelection::MessageSelection(const std::vector<RecordingFile*>& files,
                                   const std::optional<std::vector<std::string>>& topics, const ReceiptRange& range) {
  const auto isWanted = [&](const std::string& topic) {
    return !topics || std::find(topics->begin(), topics->end(), topic) != topics->end();
  };
  const auto isBefore = [](const MessageEntry& entry, StampNs stamp) { return entry.receipt < stamp; };
  for (std::size_t i = 0; i < files.size(); ++i) {
    const std::vector<Connection>& connections = files[i]->storage().connections();
    for (std::size_t c = 0; c < connections.size(); ++c) {
      if (!isWanted(connections[c].topic)) continue;
      const std::vector<MessageEntry>& index = files[i]->storage().index(c);
      auto begin = index.begin(), end = index.end();
      if (range.begin != 0) begin = std::lower_bound(begin, end, range.begin, isBefore);
      if (range.end != 0) end = std::lower_bound(begin, end, range.end, isBefore);
      if (begin == end) continue;
      first_ = size_ == 0 ? begin->receipt : std::min(first_, begin->receipt);
      last_ = std::max(last_, (end - 1)->receipt);
      size_ += static_cast<std::size_t>(end - begin);
      all_.push_back({files[i], c, i, &*begin, &*begin + (end - begin)});
    }
  }
  std::stable_sort(all_.begin(), all_.end(), [](const Cursor& a, const Cursor& b) {
    return a.file->storage().connections()[a.connection].topic < b.file->storage().connections()[b.connection].topic;
  });
  for (std::size_t i = 0; i < all_.size(); ++i) all_[i].rank = i;
  rewind();
}

bool MessageSelection::isLater(const Cursor& a, const Cursor& b) {
  return std::tie(a.at->receipt, a.rank) > std::tie(b.at->receipt, b.rank);
}

void MessageSelection::rewind() {
  heap_ = all_;
  std::make_heap(heap_.begin(), heap_.end(), isLater);
}

std::optional<RecordedMessage> MessageSelection::next() {
  if (heap_.empty()) return std::nullopt;
  std::pop_heap(heap_.begin(), heap_.end(), isLater);
  Cursor& cursor = heap_.back();
  RecordedMessage message(*cursor.file, cursor.connection, *cursor.at);
  if (++cursor.at == cursor.end) heap_.pop_back();
  else std::push_heap(heap_.begin(), heap_.end(), isLater);
  return message;
}

}  // namespace urban_nav_input
