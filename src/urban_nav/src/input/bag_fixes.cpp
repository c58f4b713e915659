// SPDX-License-Identifier: BSD-3-Clause
#include "input/bag_fixes.hpp"

#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/NavSatFix.h>

#include <cmath>
#include <list>

#include "input/bag_contents.hpp"
#include "input/bag_topics.hpp"
#include "input/open.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_ros/extrinsics.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace urban_nav {

using urban_nav_core::Vector3d;

namespace {

constexpr double kUnknownSigma = 5.0;  // m, of single receivers in towns
constexpr double kLeastSigma = 0.01;   // m

bool isUsable(const sensor_msgs::NavSatFix& fix) {
  return fix.status.status >= sensor_msgs::NavSatStatus::STATUS_FIX && std::abs(fix.latitude) <= 90.0 &&
         std::abs(fix.longitude) <= 360.0 && std::isfinite(fix.altitude) && !fix.header.stamp.isZero();
}

GpsReading toReading(const sensor_msgs::NavSatFix& fix) {
  GpsReading reading;
  reading.stamp = urban_nav_ros::toStampNs(fix.header.stamp);
  reading.latitude = fix.latitude;
  reading.longitude = fix.longitude;
  reading.height = fix.altitude;
  reading.sigma = kUnknownSigma * Vector3d(1.0, 1.0, 2.0);
  if (fix.position_covariance_type == sensor_msgs::NavSatFix::COVARIANCE_TYPE_UNKNOWN) return reading;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double variance = fix.position_covariance[4 * axis];
    if (std::isfinite(variance) && variance >= 0.0)
      reading.sigma(static_cast<Eigen::Index>(axis)) = std::max(kLeastSigma, std::sqrt(variance));
  }
  return reading;
}

void placeAntenna(std::list<rosbag::Bag>& bags, const std::string& frame, BagFixes& fixes) {
  const urban_nav_ros::StaticTransforms transforms = readTransforms(bags);
  if (const auto T_base_gps = transforms.lookup(urban_nav_core::frames::base_link, frame)) {
    fixes.p_base = T_base_gps->t();
    fixes.is_placed = true;
  }
}

}  // namespace

BagFixes readBagFixes(const std::vector<std::string>& paths, const std::vector<std::string>& topics) {
  BagFixes fixes;
  if (paths.empty() || inputKind(paths.front()) != InputKind::Bag) return fixes;
  try {
    std::list<rosbag::Bag> bags;
    for (const std::string& path : paths) bags.emplace_back(path, rosbag::bagmode::Read);
    const auto topic = chooseTopics(topicTypes(bags), topics).find(Role::Gps);
    if (!topic) return fixes;
    fixes.topic = topic->name;
    std::string frame;
    for (rosbag::Bag& bag : bags) {
      rosbag::View view(bag, rosbag::TopicQuery(topic->name));
      for (const rosbag::MessageInstance& instance : view) {
        const auto message = instance.instantiate<sensor_msgs::NavSatFix>();
        if (!message) continue;
        frame = message->header.frame_id;
        if (isUsable(*message)) fixes.readings.push_back(toReading(*message));
      }
    }
    if (!frame.empty()) placeAntenna(bags, frame, fixes);
  } catch (const rosbag::BagException& error) {
    throw urban_nav_core::DataError(paths.front(), std::string("is damaged: ") + error.what(), "");
  }
  return fixes;
}

}  // namespace urban_nav
