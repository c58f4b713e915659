// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace urban_nav_live {

/// Selects the stereo pairs that an overloaded stage processes: whole pairs, as evenly spaced as its speed permits. A
/// full queue drops single messages instead, which leaves pairs without one image and the motion between them without
/// measurements. Not thread-safe.
class PairThinning {
 public:
  /// Backlogs, as shares of the queue's capacity: thinning begins, ends, and skips all pairs. The share above kFull is
  /// for the inputs that arrive while one pair is processed: with 200 messages, of a camera, an IMU and wheels, 0.3 s.
  static constexpr double kBegin = 0.5, kEnd = 0.125, kFull = 0.75;

  /// Returns whether to process the next pair: each while the stage keeps up, every second one while it catches up,
  /// and none while the queue is nearly full. `backlog`: waiting inputs as a share of the queue's capacity.
  bool keeps(double backlog) {
    if (backlog >= kBegin) is_thinning_ = true;
    if (backlog <= kEnd) is_thinning_ = false;
    if (backlog >= kFull) return kept_last_ = false;
    return kept_last_ = !is_thinning_ || !kept_last_;
  }

 private:
  bool is_thinning_ = false, kept_last_ = false;
};

}  // namespace urban_nav_live
