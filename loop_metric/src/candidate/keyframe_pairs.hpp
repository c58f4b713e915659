// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "loop_metric/place/place_data.hpp"

namespace loop_metric {

/// Chooses which stored keyframes around two poses to match, and in which order: at most `most` pairs.
///
/// With odometry between the poses (`T_a_b`) the keyframes that it places nearest to each other come first, and there
/// are no pairs if it is certain that the headings differ. Then those nearest to the poses, which were recognised; then
/// others of a, half of `way` (m) before and after.
struct KeyframePair {
  NearbyKeyframe a, b;
};
std::vector<KeyframePair> chooseKeyframePairs(const std::vector<NearbyKeyframe>& views_a,
                                              const std::vector<NearbyKeyframe>& views_b,
                                              const std::optional<urban_nav_core::PoseWithCovariance>& T_a_b,
                                              double way, std::size_t most);

}  // namespace loop_metric
