// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "loop_metric/surroundings.hpp"

namespace loop_metric {

/// Which kept views around two moments to match, in the order in which to try them: at most `most` pairs.
///
/// Where odometry knows how the moments lie to each other (`T_a_b`), the views that it puts nearest to each other come first, and none come where it
/// is sure that the robot looked another way. Then those nearest to the moments, which are what was recognised; then others of a's, half of `way` (m)
/// before and behind.
struct ViewPair {
  NearbyView a, b;
};
std::vector<ViewPair> pairsOf(const std::vector<NearbyView>& views_a, const std::vector<NearbyView>& views_b,
                              const std::optional<urban_nav_core::PoseWithCovariance>& T_a_b, double way,
                              std::size_t most);

}  // namespace loop_metric
