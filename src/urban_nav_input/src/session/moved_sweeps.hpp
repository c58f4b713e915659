// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_core/sequence/sweep_motion_queue.hpp"
#include "urban_nav_input/session/source.hpp"

namespace urban_nav_input {

/// Sweeps of a recording with the motion inputs between them. Not thread-safe.
class MovedSweeps {
 public:
  using Queue = urban_nav_core::SweepMotionQueue<SweepInput>;

  /// `motion`: sensors whose inputs are added. Without any, sweeps pass through.
  void expect(const Queue::Options& options) {
    if (options.motion.any()) queue_.emplace(options);
  }
  void add(std::vector<SweepInput> sweeps);
  void add(const urban_nav_core::MotionInput& input) {
    if (queue_) queue_->add(input);
  }
  /// Ends the input: all sweeps are then ready.
  void finish() {
    if (queue_) queue_->finish();
  }
  /// Returns the sweeps whose inputs are complete, in the order in which they were added.
  std::vector<SweepInput> take();
  /// Returns the number of inputs that were dropped because they arrived too late.
  std::int64_t late() const { return queue_ ? queue_->late() : 0; }

  /// Reads or writes the state between two messages, when the ready sweeps were taken.
  void archive(urban_nav_core::Archive& archive);

 private:
  std::optional<Queue> queue_;
  std::vector<SweepInput> ready_;
};

}  // namespace urban_nav_input
