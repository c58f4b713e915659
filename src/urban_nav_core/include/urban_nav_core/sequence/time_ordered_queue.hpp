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

/// Statistics of one stream of a TimeOrderedQueue: inputs received, and inputs dropped by cause.
struct TimeOrderedQueueCounts {
  std::int64_t received = 0;
  std::int64_t late = 0;       ///< stamp before that of an input already delivered, or on another clock (kMostAhead)
  std::int64_t duplicate = 0;  ///< same stream and stamp as an earlier input
  std::int64_t early = 0;      ///< of a following stream, more than kMostAhead before the first input of the others
};
/// Order in which inputs of several streams arrive.
enum class DeliveryOrder {
  Shuffled,        ///< stamps may be out of order within a stream
  OrderedStreams,  ///< each stream is in order; streams have different delays
};

/// Merges several streams into one sequence ordered by (stamp, stream), which makes a stage independent of the
/// latencies of its inputs. Depends on stamps only, not on a clock.
///
/// An input may arrive up to `max_lateness` after one with a later stamp; later arrivals are dropped and counted. An
/// input is held until the newest stamp exceeds its own by max_lateness, or, with DeliveryOrder::OrderedStreams, until
/// every stream has reached its stamp. The latter is for live streams: it minimises latency, but drops a message that
/// arrives after a later one of its own stream. Streams may be optional: a stream without input while another had
/// kPatience inputs, or for a second of stamps, is not waited for. Streams may be declared as following the others:
/// inputs of other streams are never late because of them, however far their clock is ahead. `longest_wait`: in either
/// order, an input also waits for streams that have not reached its stamp, up to this lateness, so that a stream whose
/// clock is late is not dropped. Not thread-safe.
template <typename Item>
class TimeOrderedQueue {
 public:
  struct Entry {
    StampNs stamp = 0;
    int stream = 0;
    Item item;
  };

  static constexpr std::int64_t kPatience = 30;
  static constexpr StampNs kSilence = 1'000'000'000;
  /// Limit, ns, by which an input of a following stream may be ahead of the newest of the others.
  static constexpr StampNs kMostAhead = 10'000'000'000;

  /// `optional`: number of first streams that are optional. `following`: number of those that follow the others.
  TimeOrderedQueue(int streams, StampNs max_lateness, DeliveryOrder delivery = DeliveryOrder::Shuffled,
                   int optional = 0, int following = 0, StampNs longest_wait = 0)
      : counts_(static_cast<std::size_t>(streams)),
        optional_(static_cast<std::size_t>(optional)),
        following_(static_cast<std::size_t>(following)),
        reached_(counts_.size()),
        max_lateness_(max_lateness),
        longest_wait_(std::max(max_lateness, longest_wait)),
        delivery_(delivery) {}

  /// Returns false if the input is late or a duplicate, and drops it.
  bool put(int stream, StampNs stamp, Item item) {
    assert(stream >= 0 && static_cast<std::size_t>(stream) < counts_.size());
    TimeOrderedQueueCounts& counts = counts_[static_cast<std::size_t>(stream)];
    ++counts.received;
    const Place place{stamp, stream};
    const bool follows = static_cast<std::size_t>(stream) < following_;
    if (follows && newest_ && stamp - *newest_ > kMostAhead) {
      ++counts.late;
      return false;
    }
    if (handed_on_ && !(*handed_on_ < place)) {
      ++(*handed_on_ == place ? counts.duplicate : counts.late);
      return false;
    }
    const auto at = std::lower_bound(waiting_.begin(), waiting_.end(), place, [](const Entry& entry, const Place& p) {
      return Place{entry.stamp, entry.stream} < p;
    });
    if (at != waiting_.end() && at->stamp == stamp && at->stream == stream) {
      ++counts.duplicate;
      return false;
    }
    waiting_.insert(at, Entry{stamp, stream, std::move(item)});
    std::optional<StampNs>& reached = reached_[static_cast<std::size_t>(stream)];
    reached = reached ? std::max(*reached, stamp) : stamp;
    if (!follows) newest_ = newest_ ? std::max(*newest_, stamp) : stamp;
    else if (!newest_) dropBefore(*reached - kMostAhead);
    return true;
  }

  /// Removes and returns the next input. Returns nullopt while an earlier one may still arrive.
  std::optional<Entry> take() {
    if (waiting_.empty() || !mayLeave(waiting_.front())) return std::nullopt;
    Entry entry = std::move(waiting_.front());
    waiting_.erase(waiting_.begin());
    handed_on_ = Place{entry.stamp, entry.stream};
    return entry;
  }

  /// Ends all streams: take() then returns all remaining inputs.
  void finish() { finished_ = true; }

  const TimeOrderedQueueCounts& counts(int stream) const { return counts_[static_cast<std::size_t>(stream)]; }
  /// Returns the latest stamp of a stream so far.
  std::optional<StampNs> reached(int stream) const { return reached_[static_cast<std::size_t>(stream)]; }
  std::size_t waiting() const { return waiting_.size(); }
  /// Calls `see(item)` for the held inputs that are not later than `stamp`, in order.
  template <typename See>
  void forEachUntil(StampNs stamp, See see) const {
    for (const Entry& entry : waiting_) {
      if (entry.stamp > stamp) break;
      see(entry.item);
    }
  }

  /// Reads or writes the whole state; `item(Archive&, Item&)` reads or writes one item.
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
      archive.require(entry.stream >= 0 && static_cast<std::size_t>(entry.stream) < counts_.size(),
                      "a stream is unknown");
      archive.require(i == 0 || findPlace(waiting_[i - 1]) < findPlace(entry), "inputs are out of order");
    }
    for (TimeOrderedQueueCounts& counts : counts_)
      archive(counts.received, counts.late, counts.duplicate, counts.early);
    for (std::optional<StampNs>& reached : reached_) archive(reached);
    archive(newest_, handed_on_, finished_);
    archive.require(waiting_.empty() || newest_.has_value() || following_ > 0, "no input yet");
  }

 private:
  using Place = std::pair<StampNs, int>;
  static Place findPlace(const Entry& entry) { return {entry.stamp, entry.stream}; }

  bool mayLeave(const Entry& entry) const {
    if (finished_ || (newest_ && *newest_ - entry.stamp >= longest_wait_)) return true;
    const bool is_late = newest_ && *newest_ - entry.stamp >= max_lateness_;
    return (is_late || delivery_ == DeliveryOrder::OrderedStreams) && isReachedByAll(entry);
  }

  bool isReachedByAll(const Entry& entry) const {
    for (std::size_t stream = 0; stream < reached_.size(); ++stream) {
      const std::optional<StampNs>& reached = reached_[stream];
      if ((!reached || *reached < entry.stamp) && !(stream < optional_ && isSilent(stream))) return false;
    }
    return true;
  }

  /// Drops inputs of following streams that wait for the first one of the others.
  void dropBefore(StampNs stamp) {
    while (!waiting_.empty() && waiting_.front().stamp < stamp) {
      ++counts_[static_cast<std::size_t>(waiting_.front().stream)].early;
      waiting_.erase(waiting_.begin());
    }
  }

  bool isSilent(std::size_t stream) const {
    if (reached_[stream]) return newest_ && *newest_ - *reached_[stream] > kSilence;
    return std::any_of(counts_.begin(), counts_.end(),
                       [](const TimeOrderedQueueCounts& counts) { return counts.received > kPatience; });
  }

  std::vector<Entry> waiting_;  // sorted; short: inputs of the last max_lateness
  std::vector<TimeOrderedQueueCounts> counts_;
  std::size_t optional_ = 0, following_ = 0;
  std::vector<std::optional<StampNs>> reached_;
  std::optional<StampNs> newest_;
  std::optional<Place> handed_on_;
  StampNs max_lateness_, longest_wait_;
  DeliveryOrder delivery_;
  bool finished_ = false;
};

}  // namespace urban_nav_core
