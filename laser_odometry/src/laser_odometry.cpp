// SPDX-License-Identifier: BSD-3-Clause
#include "laser_odometry/laser_odometry.hpp"

#include "pipeline.hpp"

namespace laser_odometry {

class LaserOdometry::Implementation : public Pipeline {
 public:
  using Pipeline::Pipeline;
};

LaserOdometry::LaserOdometry(const Parameters& parameters, const urban_nav_core::Pose& T_base_lidar, Scanner scanner)
    : implementation_(std::make_unique<Implementation>(parameters, T_base_lidar, scanner)) {}

LaserOdometry::LaserOdometry(const Parameters& parameters, const urban_nav_core::Pose& T_base_lidar,
                             std::string_view state, Scanner scanner)
    : LaserOdometry(parameters, T_base_lidar, scanner) {
  implementation_->restore(state);
}

LaserOdometry::~LaserOdometry() = default;
LaserOdometry::LaserOdometry(LaserOdometry&&) noexcept = default;
LaserOdometry& LaserOdometry::operator=(LaserOdometry&&) noexcept = default;

LaserPose LaserOdometry::process(const urban_nav_core::Sweep& sweep, const std::optional<MotionPrior>& prior) {
  return implementation_->process(sweep, prior);
}

std::vector<MapPoint> LaserOdometry::localMap() const { return implementation_->localMap(); }
std::string LaserOdometry::state() const { return implementation_->state(); }

}  // namespace laser_odometry
