// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "urban_nav_core/types/motion_input.hpp"
#include "urban_nav_core/types/stereo_pair.hpp"

namespace urban_nav_core {

class Archive;

/// Image with shared ownership of its pixels.
struct OwnedImage {
  StampNs stamp = 0;
  ImageView view;  ///< empty: the image was received but cannot be decoded
  std::shared_ptr<const void> owner;
};

/// Stereo pair with the motion inputs after the previous pair, up to and including its stamp.
struct StereoPairWithMotion {
  StereoPair pair;                  ///< stamp: that of the left image, or of the right one without a left image
  std::vector<MotionInput> inputs;  ///< in the order of time
  std::shared_ptr<const void> left_owner, right_owner;
};

/// Assembles stereo pairs from left and right images and motion inputs in the order of TimeOrderedQueue. An image
/// without a partner is returned as a pair with an empty view as soon as a later image arrives. Depends on stamps only,
/// so the same inputs give the same pairs live and offline. Not thread-safe.
class StereoAssembler {
 public:
  /// Two images form a pair if their stamps differ by at most `tolerance`, ns.
  explicit StereoAssembler(StampNs tolerance = 5'000'000);

  void addLeft(OwnedImage image);
  void addRight(OwnedImage image);
  void addMotion(const MotionInput& input);
  /// Ends the input: an image that waits for its partner is returned without it.
  void finish();

  /// Returns the next pair that is complete, or known to remain incomplete.
  std::optional<StereoPairWithMotion> take();

  /// Return the number of images so far whose partner was missing.
  std::int64_t leftsMissing() const { return lefts_missing_; }
  std::int64_t rightsMissing() const { return rights_missing_; }

  /// Reads or writes the inputs that wait for a partner or the next pair. Requires that ready pairs have been taken.
  void archive(Archive& archive);

 private:
  void release();

  StampNs tolerance_;
  std::optional<OwnedImage> left_, right_;  // at most one of them is waiting
  std::deque<MotionInput> motion_;
  std::deque<StereoPairWithMotion> ready_;
  std::int64_t lefts_missing_ = 0, rights_missing_ = 0;
};

}  // namespace urban_nav_core
