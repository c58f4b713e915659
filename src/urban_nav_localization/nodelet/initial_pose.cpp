// SPDX-License-Identifier: BSD-3-Clause
#include "initial_pose.hpp"

#include <cmath>
#include <limits>

#include "urban_nav_core/geometry/dense.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_ros/pose.hpp"

namespace urban_nav_localization {

using urban_nav_core::Matrix6d;
using urban_nav_core::UserError;

namespace {

// Deviations of a wheeled robot near the path of the map: kerbs, and slopes up to about ten degrees.
constexpr double kHeightSigma = 1.0;  // m
constexpr double kTiltSigma = 0.2;    // rad
// The accuracy of a click on a map; a smaller variance, or none, was not set deliberately.
constexpr double kLeastSigma = 0.01;  // m, rad

std::string withoutSlash(const std::string& frame) { return frame.rfind('/', 0) == 0 ? frame.substr(1) : frame; }

}  // namespace

urban_nav_core::PoseWithCovariance toInitialPose(const geometry_msgs::PoseWithCovarianceStamped& message,
                                                 const std::string& map_frame, const std::string& where,
                                                 const std::vector<urban_nav_store::StoredTrajectory>& map) {
  if (withoutSlash(message.header.frame_id) != withoutSlash(map_frame))
    throw UserError(where, "frame_id `" + message.header.frame_id + "`", map_frame);
  const auto pose = urban_nav_ros::toPose(message.pose.pose);
  if (!pose) throw UserError(where, "the pose is not finite, or its quaternion is invalid", "");
  urban_nav_core::PoseWithCovariance initial_pose{*pose, urban_nav_ros::toMatrix6(message.pose.covariance)};
  Matrix6d& covariance = initial_pose.covariance;
  const auto values = covariance.allFinite() ? urban_nav_core::symmetricEigenvalues(covariance) : std::nullopt;
  const double scale = values ? std::max(1.0, covariance.cwiseAbs().maxCoeff()) : 1.0;
  if (!values || (*values)[0] < -1e-9 * scale ||
      (covariance - covariance.transpose()).cwiseAbs().maxCoeff() > 1e-9 * scale)
    throw UserError(where, "the covariance is not valid", "finite, symmetric, no negative eigenvalue");
  if (covariance(2, 2) <= 0.0) {
    double nearest = std::numeric_limits<double>::infinity(), height = pose->t().z();
    for (const urban_nav_store::StoredTrajectory& session : map)
      for (const urban_nav_core::StampedPose& each : session.T_map_base) {
        const double way = (each.pose.t() - pose->t()).head<2>().norm();
        if (way >= nearest) continue;
        nearest = way;
        height = each.pose.t().z();
      }
    initial_pose.pose = urban_nav_core::Pose(pose->q(), {pose->t().x(), pose->t().y(), height});
    covariance(2, 2) = kHeightSigma * kHeightSigma;
  }
  for (const int tilt : {3, 4})
    if (covariance(tilt, tilt) <= 0.0) covariance(tilt, tilt) = kTiltSigma * kTiltSigma;
  covariance.diagonal().array() += kLeastSigma * kLeastSigma;
  return initial_pose;
}

}  // namespace urban_nav_localization
