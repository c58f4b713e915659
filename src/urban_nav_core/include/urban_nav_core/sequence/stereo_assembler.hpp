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

/// An image with shared ownership of its pixels.
struct OwnedImage {
  StampNs stamp = 0;
  ImageView view;  ///< empty: the image came, but cannot be read
  std::shared_ptr<const void> owner;
};

/// A stereo pair with the motion inputs that ended after the previous pair, up to and including its stamp.
struct StereoPairWithMotion {
  StereoPair pair;                  ///< stamp: the left image's; the right one's where there is no left
  std::vector<MotionInput> inputs;  ///< in the order of time
  std::shared_ptr<const void> left_owner, right_owner;
};

/// Left and right images and motion inputs, in the order in which a TimeOrderedQueue hands them on, become stereo
/// pairs. An image whose partner did not come leaves as a pair with an empty view as soon as a later image shows that:
/// by stamps alone, so the same inputs give the same pairs whether live or from a file. Not thread-safe.
class StereoAssembler {
 public:
  /// Two images belong together if their stamps differ by at most `tolerance`.
  explicit StereoAssembler(StampNs tolerance = 5'000'000);

  void addLeft(OwnedImage image);
  void addRight(OwnedImage image);
  void addMotion(const MotionInput& input);
  /// No more images will come: the one that waits for its partner leaves alone.
  void finish();

  /// The next pair that is complete, or known to stay incomplete.
  std::optional<StereoPairWithMotion> take();

  /// Images that left without their partner so far.
  std::int64_t leftsMissing() const { return lefts_missing_; }
  std::int64_t rightsMissing() const { return rights_missing_; }

  /// What waits for a partner, or for the next pair. Pairs that are ready must have been taken.
  void archive(Archive& archive);

 private:
  void release();

  StampNs tolerance_;
  std::optional<OwnedImage> left_, right_;  // at most one of them waits
  std::deque<MotionInput> motion_;
  std::deque<StereoPairWithMotion> ready_;
  std::int64_t lefts_missing_ = 0, rights_missing_ = 0;
};

}  // namespace urban_nav_core
