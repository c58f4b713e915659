// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "urban_nav_core/types/pose_with_covariance.hpp"
#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_core {

/// Session of a live odometry, which defines its beginning and id for all other stages.
struct OdometrySession {
  std::string id;  ///< 20 hexadecimal digits
  std::string name, robot, recording;
  StampNs start = 0;  ///< stamp of the first frame
};

/// Shared by the steps of a session; null if the odometry does not publish it.
using OdometrySessionPtr = std::shared_ptr<const OdometrySession>;

/// Step of a live odometry, and the session of both of its poses.
struct SessionStep : RelativePose {
  SessionStep() = default;
  SessionStep(RelativePose step, OdometrySessionPtr announced = nullptr)  // implicit: a step whose session is unknown
      : RelativePose(std::move(step)), session(std::move(announced)) {}
  OdometrySessionPtr session;
};

/// Returns the id; empty: not published.
inline const std::string& sessionId(const OdometrySessionPtr& session) {
  static const std::string none;
  return session ? session->id : none;
}

}  // namespace urban_nav_core
