// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "urban_nav_core/io/archive_types.hpp"
#include "urban_nav_core/sequence/time_ordered_queue.hpp"
#include "urban_nav_core/types/motion_input.hpp"

namespace urban_nav_core {

/// Gives each sweep the motion inputs since the previous one, up to the end of the sweep: those of the motion within it
/// are included. Sweeps keep their order. Depends on stamps only, so that the same inputs give the same sequence live
/// and offline. Without motion sensors, sweeps pass through. Not thread-safe.
template <typename SweepItem>
class SweepMotionQueue {
 public:
  struct Options {
    StampNs max_lateness = 50'000'000;  ///< ns, of inputs and sweeps (TimeOrderedQueue)
    StampNs longest_wait = 0;           ///< ns, for a stream with early stamps
    DeliveryOrder delivery = DeliveryOrder::Shuffled;
    MotionChoice motion;  ///< expected inputs; a silent one is waited for only if it is required
  };
  struct Ready {
    SweepItem sweep;
    std::vector<MotionInput> inputs;  ///< in order of time
  };

  explicit SweepMotionQueue(const Options& options)
      : motion_(options.motion),
        sweep_stream_((motion_.gyroscope ? 1 : 0) + (motion_.wheels ? 1 : 0)),
        queue_(sweep_stream_ + 1, options.max_lateness, options.delivery, motion_.is_required ? 0 : sweep_stream_,
               sweep_stream_, options.longest_wait) {}

  /// `end`: stamp of the last beam.
  void add(StampNs end, SweepItem sweep) {
    if (!motion_.any()) return passing_.push_back(std::move(sweep));
    last_ = last_ ? std::max(end, *last_ + 1) : end;
    queue_.put(sweep_stream_, *last_, Item(std::move(sweep)));
  }
  /// Inputs of sensors that are not expected are dropped.
  void add(const MotionInput& input) {
    const bool is_wheels = input.source == MotionSource::Wheels, is_gyroscope = input.source == MotionSource::Gyroscope;
    if (is_wheels ? motion_.wheels : is_gyroscope && motion_.gyroscope)
      queue_.put(is_wheels && motion_.gyroscope ? 1 : 0, input.to, Item(input));
  }
  /// Ends the input: take() then returns all remaining sweeps.
  void finish() { queue_.finish(); }

  /// Returns the next sweep whose inputs are complete.
  std::optional<Ready> take() {
    if (!passing_.empty()) {
      Ready ready{std::move(passing_.front()), {}};
      passing_.pop_front();
      return ready;
    }
    while (auto entry = queue_.take()) {
      if (auto* input = std::get_if<MotionInput>(&entry->item)) {
        inputs_.push_back(std::move(*input));
        continue;
      }
      return Ready{std::move(std::get<SweepItem>(entry->item)), std::exchange(inputs_, {})};
    }
    return std::nullopt;
  }

  /// Returns the number of inputs that arrived too late.
  std::int64_t late() const {
    std::int64_t sum = 0;
    for (int stream = 0; stream < sweep_stream_; ++stream) sum += queue_.counts(stream).late;
    return sum;
  }

  /// Reads or writes the state between two inputs, when take() returns nothing more; `sweep(Archive&, SweepItem&)`
  /// reads or writes a sweep.
  template <typename ArchiveSweep>
  void archive(Archive& archive, ArchiveSweep sweep) {
    queue_.archive(archive, [&sweep](Archive& items, Item& item) {
      bool is_motion = std::holds_alternative<MotionInput>(item);
      items(is_motion);
      if (items.isReading()) item = is_motion ? Item(MotionInput()) : Item(SweepItem());
      if (is_motion) items(std::get<MotionInput>(item));
      else sweep(items, std::get<SweepItem>(item));
    });
    archive(inputs_, last_);
  }

 private:
  using Item = std::variant<MotionInput, SweepItem>;

  MotionChoice motion_;
  int sweep_stream_;
  TimeOrderedQueue<Item> queue_;
  std::deque<SweepItem> passing_;    // without motion sensors
  std::vector<MotionInput> inputs_;  // since the previous sweep
  std::optional<StampNs> last_;      // place of the newest sweep in the order
};

}  // namespace urban_nav_core
