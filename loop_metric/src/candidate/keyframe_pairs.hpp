// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "loop_metric/place/place_data.hpp"

namespace loop_metric {

/// Selects pairs of stored keyframes around two poses for matching, in order of preference: at most `most` pairs.
///
/// With odometry between the poses (`T_a_b`), the keyframes nearest to each other come first, and there are no pairs if
/// the headings certainly differ. Then the keyframes nearest to the poses, where the place was recognised; then other
/// keyframes of a, half of `search_distance` (m) before and after.
struct KeyframePair {
  NearbyKeyframe a, b;
};
std::vector<KeyframePair> chooseKeyframePairs(const std::vector<NearbyKeyframe>& views_a,
                                              const std::vector<NearbyKeyframe>& views_b,
                                              const std::optional<urban_nav_core::PoseWithCovariance>& T_a_b,
                                              double search_distance, std::size_t most);

}  // namespace loop_metric
