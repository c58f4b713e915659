// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sensor_msgs/PointCloud2.h>

#include <optional>
#include <string>
#include <vector>

#include "urban_nav_core/laser/cloud/cloud_survey.hpp"
#include "urban_nav_core/laser/cloud/planar_cloud.hpp"
#include "urban_nav_core/laser/cloud/sweep_reader.hpp"

namespace urban_nav_ros {

/// Converts the clouds of one 3D LiDAR to sweeps, like the reader of recordings. Conventions are determined from the
/// first CloudSurvey::kEnough clouds, which wait until then. Clouds of a planar laser are discarded. Not thread-safe.
class SweepFeed {
 public:
  explicit SweepFeed(urban_nav_core::CloudOptions options = {});

  /// Returns the sweeps that are ready after a message, in the order of their messages.
  std::vector<urban_nav_core::ReadSweep> add(const sensor_msgs::PointCloud2ConstPtr& message);
  /// Returns the conventions of the clouds; nullopt until they are determined.
  std::optional<urban_nav_core::CloudConvention> convention() const;
  /// Returns why the clouds are not used; empty: they are used, or the decision is pending.
  const std::string& fault() const { return fault_; }

 private:
  static constexpr std::size_t kMostWaiting = 50;  // clouds, with points or without

  urban_nav_core::CloudOptions options_;
  urban_nav_core::CloudSurvey survey_;
  urban_nav_core::PlanarCloudSurvey planar_survey_;
  std::string fault_;
  std::vector<sensor_msgs::PointCloud2ConstPtr> waiting_;
  std::optional<urban_nav_core::SweepReader> reader_;
};

}  // namespace urban_nav_ros
