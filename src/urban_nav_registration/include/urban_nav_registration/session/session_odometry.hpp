// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "urban_nav_core/trajectory/odometry_chain.hpp"
#include "urban_nav_core/types/pose_with_covariance.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav_registration {

/// Returns true if a step is finite and forward in time.
bool isUsable(const urban_nav_core::RelativePose& step);

/// Odometry of a session. A gap between two steps starts a new part, whose pose relative to earlier parts is unknown.
class SessionOdometry {
 public:
  using Part = std::shared_ptr<urban_nav_core::OdometryChain>;

  /// Appends a step. Returns false, and ignores it, if it is earlier than the previous ones or not finite.
  bool add(const urban_nav_core::RelativePose& step);
  const std::vector<Part>& parts() const { return parts_; }
  /// Returns the index of the part that covers a stamp, or of the last part.
  std::size_t partAt(urban_nav_core::StampNs stamp) const;
  bool empty() const { return parts_.empty(); }
  /// Returns the stamp of the newest pose; 0 if there is none.
  urban_nav_core::StampNs newest() const;

 private:
  std::vector<Part> parts_;
};

/// Reads the odometry stored with the poses of a session; no parts if there are none. Throws DataError if the store is
/// damaged.
SessionOdometry readOdometry(urban_nav_store::Store& store, const urban_nav_store::SessionId& session);

}  // namespace urban_nav_registration
