// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <map>

#include "urban_nav/stored_results.hpp"

namespace urban_nav {

using urban_nav_core::Matrix6d;
using urban_nav_core::StampNs;

StoredCovariances readStoredCovariances(urban_nav_store::Store& store, const urban_nav_store::SessionId& session) {
  std::map<StampNs, Matrix6d> relaxed;
  store.graph().forEachRelaxed(session, [&](const urban_nav_store::RelaxedPose& pose) {
    relaxed.emplace_hint(relaxed.end(), pose.stamp, pose.covariance);
  });
  StoredCovariances covariances;
  store.graph().forEachNode(session, [&](const urban_nav_store::Node& node) {
    const auto found = relaxed.find(node.stamp);
    if (!covariances.poses.empty()) covariances.steps.push_back(node.covariance);
    covariances.poses.push_back(found != relaxed.end() ? found->second : node.covariance_from_first);
  });
  // Only the first pose of a map has a zero covariance.
  const bool unknown =
      covariances.poses.size() > 1 && std::all_of(covariances.poses.begin(), covariances.poses.end(),
                                                  [](const Matrix6d& covariance) { return covariance.isZero(0.0); });
  if (unknown) covariances.poses.clear();
  return covariances;
}

}  // namespace urban_nav
