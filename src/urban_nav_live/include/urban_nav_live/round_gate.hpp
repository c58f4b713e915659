// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "urban_nav_core/sequence/time_jump.hpp"
#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_live {

/// Delivers the items of several streams round by round. A round ends when stamps jump back: a recording restarts or a
/// clock is set back. Streams have separate connections, so that one may jump back before another: items of the next
/// round wait until the leading streams have arrived there, and later items of the previous round are dropped. One jump
/// of the clock therefore ends exactly one session, in any order of arrival. Not thread-safe.
template <typename Item>
class RoundGate {
 public:
  using StampNs = urban_nav_core::StampNs;
  struct Options {
    /// Streams that must arrive in the next round, if they had items in this one, before it begins.
    std::set<int> leading;
    /// Alternative condition: items of the next round span this time, ns, because a leading stream is silent.
    StampNs patience = urban_nav_core::kMaxStepBack;
    std::size_t capacity = 100'000;  ///< of waiting items; beyond it the oldest is dropped
  };
  struct Listener {
    std::function<void(Item&)> item;        ///< item of the current round
    std::function<void()> next_round = {};  ///< later items belong to the next round
  };

  RoundGate(Options options, Listener listener) : options_(std::move(options)), listener_(std::move(listener)) {}

  /// Adds an item of a stream. Calls the listener.
  void add(int stream, StampNs stamp, Item item) {
    const int round = toRound(stream, stamp);
    if (round < round_) {
      ++dropped_;
      return;
    }
    if (round == round_) return listener_.item(item);
    waiting_.push_back({round, stamp, std::move(item)});
    if (waiting_.size() > options_.capacity) {
      waiting_.pop_front();
      ++dropped_;
    }
    if (isDue()) beginNext();
  }
  /// Begins the next round if items of it are waiting.
  void flush() {
    while (!waiting_.empty()) beginNext();
  }

  /// Returns the number of backward jumps.
  int round() const { return round_; }
  std::int64_t dropped() const { return dropped_; }

 private:
  struct Stream {
    int round = 0;
    StampNs newest = 0;
  };
  struct Waiting {
    int round = 0;
    StampNs stamp = 0;
    Item item;
  };

  /// Returns the round of an item. A stream that had no item across its own jump, as one with few items may, is
  /// assigned to the newest round as soon as its stamps are not ahead of that round.
  int toRound(int stream, StampNs stamp) {
    const auto [found, is_new] = streams_.try_emplace(stream, Stream{newest_round_, stamp});
    Stream& known = found->second;
    if (!is_new && urban_nav_core::jumpsBack(stamp, known.newest)) {
      ++known.round;
      known.newest = stamp;
    } else if (known.round < newest_round_ && stamp <= newest_) {
      known = {newest_round_, stamp};
    }
    known.newest = std::max(known.newest, stamp);
    if (known.round > newest_round_) {
      newest_round_ = known.round;
      newest_ = stamp;
    } else if (known.round == newest_round_) {
      newest_ = std::max(newest_, stamp);
    }
    return known.round;
  }

  bool isDue() const {
    const bool all_there = std::all_of(options_.leading.begin(), options_.leading.end(), [this](int stream) {
      const auto found = streams_.find(stream);
      return found == streams_.end() || found->second.round > round_;
    });
    if (all_there) return true;
    StampNs first = std::numeric_limits<StampNs>::max(), last = std::numeric_limits<StampNs>::min();
    for (const Waiting& each : waiting_) {
      if (each.round != waiting_.front().round) continue;
      first = std::min(first, each.stamp);
      last = std::max(last, each.stamp);
    }
    return last - first > options_.patience;
  }

  void beginNext() {
    round_ = std::min_element(waiting_.begin(), waiting_.end(), [](const Waiting& a, const Waiting& b) {
               return a.round < b.round;
             })->round;
    if (listener_.next_round) listener_.next_round();
    for (Waiting& each : std::exchange(waiting_, {})) {
      if (each.round == round_) listener_.item(each.item);
      else waiting_.push_back(std::move(each));
    }
  }

  const Options options_;
  const Listener listener_;
  std::map<int, Stream> streams_;
  int round_ = 0, newest_round_ = 0;
  StampNs newest_ = 0;  // in the newest round
  std::deque<Waiting> waiting_;
  std::int64_t dropped_ = 0;
};

}  // namespace urban_nav_live
