// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_input/examination/finding.hpp"

namespace urban_nav_input {

/// Condition on the stamps of the two images of a pair: |stamp of left - (stamp of right - right_delay)| <= tolerance.
struct PairingConvention {
  urban_nav_core::StampNs right_delay = 0;        ///< ns, delay of the stamps of right images relative to left ones
  urban_nav_core::StampNs tolerance = 5'000'000;  ///< ns
};

/// Relation of the stamps of two cameras with incomplete pairs, and the convention that would pair them.
struct PairingVerdict {
  bool is_constant = false;                      ///< the delay is the same for nearly all pairs
  urban_nav_core::StampNs least = 0, most = 0;   ///< ns, of the delays of right images; equal if constant
  std::optional<PairingConvention> repair = {};  ///< convention that pairs the images; nullopt: none
};

/// Compares the stamps of left and right images. Left and right stamps are in the order of time, as recorded;
/// `present`: the convention by which they were paired. nullopt if there are fewer than three of a side, or if all
/// images with a partner are already paired, i.e. the others were lost.
std::optional<PairingVerdict> examinePairing(const std::vector<urban_nav_core::StampNs>& left,
                                             const std::vector<urban_nav_core::StampNs>& right,
                                             const PairingConvention& present);

/// Collects the stamps of the images of a recording, and explains images without partner. Not thread-safe.
class PairingExamination {
 public:
  /// `side`: 0 left, 1 right. `stamp`: as recorded.
  void add(std::size_t side, urban_nav_core::StampNs stamp) {
    constexpr std::size_t kMostStamps = 20'000;  // of a side: a quarter of an hour at 20 Hz
    if (stamps_[side].size() < kMostStamps) stamps_[side].push_back(stamp);
  }
  /// Returns a finding for images without partner: one with options if stamps explain them, otherwise one for each
  /// side. `topics`, `missing`: name and number of images without partner of the left and the right side.
  std::vector<Finding> findings(const std::array<std::string, 2>& topics, const std::array<std::int64_t, 2>& missing,
                                const PairingConvention& present) const;

 private:
  std::array<std::vector<urban_nav_core::StampNs>, 2> stamps_;  // left, right
};

}  // namespace urban_nav_input
