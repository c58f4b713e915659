// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_core {

/// What came to an Inbox and was not handed on, per stream.
struct InboxCounts {
  std::int64_t received = 0;
  std::int64_t late = 0;     ///< earlier than something that had already been handed on
  std::int64_t doubled = 0;  ///< same stream and stamp as one before
};

enum class InboxArrival {
  Shuffled,        ///< also within a stream
  OrderedStreams,  ///< each stream by itself comes in order; streams are delayed against each other
};

/// Merges several streams into one order: (stamp, stream). Between subscriptions or a bag reader and a stage stands one
/// of these, so that a stage sees the same sequence however its inputs were delayed on their way. Judges by stamps
/// alone and reads no clock.
///
/// An input may come up to `max_lateness` behind one with a later stamp; what comes later still is counted and dropped.
/// The price is that inputs are held back: until a stamp has come that is later by max_lateness, or, with
/// Arrival::OrderedStreams, until every stream has come as far as the input, since then nothing earlier can follow.
/// That is the choice for live streams, where an answer at once is worth more than a message that overtook another of
/// its own stream. Not thread-safe.
template <typename Item>
class Inbox {
 public:
  using Arrival = InboxArrival;
  struct Entry {
    StampNs stamp = 0;
    int stream = 0;
    Item item;
  };

  Inbox(int streams, StampNs max_lateness, Arrival arrival = Arrival::Shuffled)
      : counts_(static_cast<std::size_t>(streams)),
        reached_(counts_.size()),
        max_lateness_(max_lateness),
        arrival_(arrival) {}

  /// False: it came too late or twice, and is dropped.
  bool put(int stream, StampNs stamp, Item item) {
    assert(stream >= 0 && static_cast<std::size_t>(stream) < counts_.size());
    InboxCounts& counts = counts_[static_cast<std::size_t>(stream)];
    ++counts.received;
    const Place place{stamp, stream};
    if (handed_on_ && !(*handed_on_ < place)) {
      ++(*handed_on_ == place ? counts.doubled : counts.late);
      return false;
    }
    const auto at = std::lower_bound(waiting_.begin(), waiting_.end(), place, [](const Entry& entry, const Place& p) {
      return Place{entry.stamp, entry.stream} < p;
    });
    if (at != waiting_.end() && at->stamp == stamp && at->stream == stream) {
      ++counts.doubled;
      return false;
    }
    waiting_.insert(at, Entry{stamp, stream, std::move(item)});
    std::optional<StampNs>& reached = reached_[static_cast<std::size_t>(stream)];
    reached = reached ? std::max(*reached, stamp) : stamp;
    newest_ = newest_ ? std::max(*newest_, stamp) : stamp;
    return true;
  }

  /// The next input, if nothing that may still come belongs before it.
  std::optional<Entry> take() {
    if (waiting_.empty() || !mayLeave(waiting_.front())) return std::nullopt;
    Entry entry = std::move(waiting_.front());
    waiting_.erase(waiting_.begin());
    handed_on_ = Place{entry.stamp, entry.stream};
    return entry;
  }

  /// Nothing more will come: all that waits may leave.
  void finish() { finished_ = true; }

  const InboxCounts& counts(int stream) const { return counts_[static_cast<std::size_t>(stream)]; }
  /// The latest stamp of a stream so far: who lags behind whom, and by how much.
  std::optional<StampNs> reached(int stream) const { return reached_[static_cast<std::size_t>(stream)]; }
  std::size_t waiting() const { return waiting_.size(); }

  /// What waits, and what has been seen and handed on; `item(Archive&, Item&)` is for what only the caller knows.
  template <typename ArchiveItem>
  void archive(Archive& archive, ArchiveItem item) {
    std::size_t size = waiting_.size();
    archive.count(size);
    if (archive.isReading()) waiting_.clear();
    for (std::size_t i = 0; i < size; ++i) {
      if (archive.isReading()) waiting_.emplace_back();
      Entry& entry = waiting_[i];
      archive(entry.stamp, entry.stream);
      item(archive, entry.item);
      archive.require(entry.stream >= 0 && static_cast<std::size_t>(entry.stream) < counts_.size(), "no such stream");
      archive.require(i == 0 || placeOf(waiting_[i - 1]) < placeOf(entry), "inputs are out of order");
    }
    for (InboxCounts& counts : counts_) archive(counts.received, counts.late, counts.doubled);
    for (std::optional<StampNs>& reached : reached_) archive(reached);
    archive(newest_, handed_on_, finished_);
    archive.require(waiting_.empty() || newest_.has_value(), "nothing has come");
  }

 private:
  using Place = std::pair<StampNs, int>;
  static Place placeOf(const Entry& entry) { return {entry.stamp, entry.stream}; }

  bool mayLeave(const Entry& entry) const {
    if (finished_ || *newest_ - entry.stamp >= max_lateness_) return true;
    if (arrival_ == Arrival::Shuffled) return false;
    return std::all_of(reached_.begin(), reached_.end(),
                       [&](const std::optional<StampNs>& reached) { return reached && *reached >= entry.stamp; });
  }

  std::vector<Entry> waiting_;  // sorted; short: what comes in max_lateness
  std::vector<InboxCounts> counts_;
  std::vector<std::optional<StampNs>> reached_;
  std::optional<StampNs> newest_;
  std::optional<Place> handed_on_;
  StampNs max_lateness_;
  Arrival arrival_;
  bool finished_ = false;
};

}  // namespace urban_nav_core
