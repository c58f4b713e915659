// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "urban_nav_core/trajectory/odometry_chain.hpp"
#include "urban_nav_core/types/pose_with_covariance.hpp"
#include "urban_nav_store/store.hpp"

namespace loop_metric {

/// Finite, and forward in time.
bool isUsable(const urban_nav_core::RelativePose& step);

/// A session's odometry. Where a step does not begin at the end of the one before, what follows is a part of its own, of which nothing is
/// known beside the parts before it.
class SessionOdometry {
 public:
  using Part = std::shared_ptr<urban_nav_core::OdometryChain>;

  /// False, and left out, where it goes back in time or is not finite.
  bool add(const urban_nav_core::RelativePose& step);
  const std::vector<Part>& parts() const { return parts_; }
  /// The part that knows the moment, else the last one.
  std::size_t partAt(urban_nav_core::StampNs stamp) const;
  bool empty() const { return parts_.empty(); }
  /// Stamp of the newest pose; 0 where there is none.
  urban_nav_core::StampNs newest() const;

 private:
  std::vector<Part> parts_;
};

/// As it is stored with the nodes of a session; no parts where there are none. DataError where the store is damaged.
SessionOdometry readOdometry(urban_nav_store::Store& store, const urban_nav_store::SessionId& session);

}  // namespace loop_metric
