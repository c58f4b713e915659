// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/keyframe_keeper.hpp"

#include <algorithm>

#include "loop_metric/stored_surroundings.hpp"

namespace urban_nav {

KeyframeKeeper::KeyframeKeeper(const loop_metric::Parameters& parameters, const urban_nav_core::StereoCamera& camera)
    : choice_(parameters), maker_(camera, parameters.points) {}

void KeyframeKeeper::goOn(const VoRun& run, const std::vector<urban_nav_core::StampNs>& kept) {
  for (const VoRow& row : run.rows)
    if (std::binary_search(kept.begin(), kept.end(), row.stamp)) choice_.keep(row.T_odom_base);
}

std::optional<urban_nav_store::StoredKeyframe> KeyframeKeeper::process(const urban_nav_core::StereoPair& pair,
                                                                       const VoRow& row) {
  if (!row.accepted || pair.left.empty() || pair.right.empty()) return std::nullopt;
  if (!choice_.choose(row.T_odom_base)) return std::nullopt;
  return loop_metric::storedKeyframe(maker_.make({"", row.stamp}, pair));
}

}  // namespace urban_nav
