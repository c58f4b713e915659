// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "urban_nav_core/testing/rendered_sequence.hpp"

namespace urban_nav_core::testing {

/// Faults of a stream of stereo pairs.
enum class FaultKind {
  Black,          ///< grey level 0 in both images
  Freeze,         ///< the last images before the fault are repeated, with new stamps
  Swap,           ///< left and right exchanged
  Drop,           ///< frames are missing; value: their share, 0...1 (default 1)
  OverExpose,     ///< grey levels times value (default 4), clipped
  Blur,           ///< both images under a Gaussian; value: standard deviation in px (default 4)
  Corrupt,        ///< rows of random grey levels; value: their share, 0...1 (default 0.3)
  NoLeft,         ///< the left image is missing
  NoRight,        ///< the right image is missing
  StampJump,      ///< stamps are later by value in s (default 10; may be negative)
  StampEqual,     ///< the stamp of the frame before the fault
  StampBackward,  ///< stamps run backwards from the one before the fault
};
/// Returns "black", "freeze", "swap", "drop", "overexpose", "blur", "corrupt", "noleft", "noright", "jump", "equal" or
/// "backward".
const char* toString(FaultKind kind);

/// Fault during an interval. Times count from the first frame of the stream.
struct Fault {
  FaultKind kind = FaultKind::Black;
  double start_s = 0.0;
  double duration_s = 1.0;
  std::optional<double> value;  ///< meaning and default by FaultKind

  bool isActive(StampNs since_first) const;
};

/// Parses "KIND:START_S:DURATION_S[:VALUE]", "black:2:1", "drop:0:100:0.3". Throws UserError with the valid values.
Fault parseFault(const std::string& text);

/// Applies faults to a stream of frames. Deterministic for the same seed and frames. Not thread-safe.
class FaultFilter {
 public:
  FaultFilter(std::vector<Fault> faults, std::uint32_t seed);

  /// Returns the frame with its faults; nullopt if it was dropped. Frames must be in order of their true stamps.
  std::optional<StereoFrame> apply(const StereoFrame& frame);

 private:
  bool spoil(const Fault& fault, const StereoFrame& original, StereoFrame& frame) const;
  double chance(std::uint64_t what) const;

  std::vector<Fault> faults_;
  std::uint32_t seed_;
  std::uint64_t count_ = 0;
  std::optional<StampNs> first_stamp_;
  StereoFrame last_good_;  ///< newest frame without a fault, with its true stamp
};

}  // namespace urban_nav_core::testing
