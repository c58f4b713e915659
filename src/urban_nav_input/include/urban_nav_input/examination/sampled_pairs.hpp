// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "urban_nav_core/sequence/stereo_assembler.hpp"
#include "urban_nav_input/examination/pair_check.hpp"
#include "urban_nav_input/examination/repeated_images.hpp"
#include "urban_nav_input/examination/sight_meter.hpp"

namespace urban_nav_input {

/// Examines the images of some evenly distributed stereo pairs of a recording, and all pairs for repeated images. Not
/// thread-safe.
class SampledPairs {
 public:
  /// `info`: of the recording. Examines about `samples` pairs, at least `least_step` apart.
  SampledPairs(SourceInfo info, std::int64_t samples, std::int64_t least_step);

  /// Adds the next pair. Its images must stay valid until the pair after the next one.
  void add(const urban_nav_core::StereoPairWithMotion& pair);
  std::vector<Finding> findings() const;
  /// Returns motion and ground measured from these pairs.
  const Sight& sight() const { return sight_.sight(); }

 private:
  SourceInfo info_;
  std::int64_t step_, most_, count_ = 0;
  std::deque<urban_nav_core::StereoPairWithMotion> last_;  // up to three, to compare partners with their neighbours
  PairCheck images_;
  RepeatedImages repeated_;
  SightMeter sight_;
  std::vector<urban_nav_core::StampNs> intervals_;  // ns, of the first pairs
};

}  // namespace urban_nav_input
