// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "urban_nav_core/types/stereo_pair.hpp"
#include "urban_nav_input/examination/finding.hpp"

namespace urban_nav_input {

/// Counts images identical to the previous one, for each camera of a stereo pair, since sensor noise never repeats.
/// Cheap, since differing images mostly differ in the first row. Not thread-safe.
class RepeatedImages {
 public:
  /// Compares a pair with the previous one. Missing images count as different.
  void add(const urban_nav_core::StereoPair& before, const urban_nav_core::StereoPair& now);
  std::vector<Finding> findings() const;

 private:
  struct Count {
    std::int64_t repeated = 0, runs = 0, longest = 0,
                 run = 0;  ///< images; series; images of the longest and the current series
    urban_nav_core::StampNs first = 0;
    void add(bool is_repeated, urban_nav_core::StampNs stamp);
  };
  std::string share(const Count& count) const;

  std::int64_t compared_ = 0;
  std::array<Count, 3> counts_;  // only left, only right, both
};

}  // namespace urban_nav_input
