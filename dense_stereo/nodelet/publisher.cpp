// SPDX-License-Identifier: BSD-3-Clause
#include "publisher.hpp"

#include <cmath>

#include "dense_stereo/depth_samples.hpp"
#include "messages.hpp"
#include "urban_nav_ros/depth_view.hpp"
#include "urban_nav_ros/topics.hpp"

namespace dense_stereo {

namespace topics = urban_nav_ros::topics;

Publisher::Publisher(urban_nav_ros::StageNode& node, double view_interval)
    : node_(node),
      view_interval_(std::llround(1e9 * view_interval)),
      disparity_(node.nh().advertise<stereo_msgs::DisparityImage>(topics::kStereoDisparity, 5)),
      points_(node.nh().advertise<sensor_msgs::PointCloud2>(topics::kStereoPoints, 5)),
      ground_(node.nh().advertise<urban_nav_msgs::GroundPlane>(topics::kGroundPlane, 20)),
      obstacles_(node.nh().advertise<sensor_msgs::PointCloud2>(topics::kObstacles, 5)),
      view_(node.nh().advertise<urban_nav_msgs::DepthView>(topics::kDepthView, 5)) {}

void Publisher::startSession(const std::string& frame, const urban_nav_core::StereoCamera& camera, int disparities) {
  frame_ = frame;
  camera_ = camera;
  disparities_ = (disparities + 15) / 16 * 16;
  last_view_ = 0;
  node_.restartStatus();
}

bool Publisher::isViewDue(urban_nav_core::StampNs stamp) const {
  const urban_nav_core::StampNs since = stamp - last_view_;
  return view_.getNumSubscribers() > 0 && (since < 0 || since >= view_interval_);
}

bool Publisher::isWanted(urban_nav_core::StampNs stamp) const {
  for (const ros::Publisher* publisher : {&disparity_, &points_, &ground_, &obstacles_})
    if (publisher->getNumSubscribers() > 0) return true;
  return isViewDue(stamp);
}

void Publisher::publish(const NearScene& scene, const urban_nav_core::StereoPair& pair) {
  const urban_nav_core::Status& status = scene.stereo.status;
  node_.publishStatus(status, toString(static_cast<Reason>(status.reason)), pair.stamp);
  if (pair.left.empty()) return;
  std_msgs::Header header;
  header.stamp = urban_nav_ros::toRosTime(pair.stamp);
  header.frame_id = frame_;
  if (disparity_.getNumSubscribers() > 0)
    disparity_.publish(toDisparityMessage(scene.stereo.image, camera_, disparities_, header));
  if (points_.getNumSubscribers() > 0) points_.publish(toPointsMessage(scene.stereo.image, camera_, pair.left, header));
  if (isViewDue(pair.stamp) && scene.stereo.answered > 0.0) {
    view_.publish(urban_nav_ros::toDepthViewMessage(sampleDepths(scene.stereo.image, pair.left, camera_), header));
    last_view_ = pair.stamp;
  }
  ground_.publish(toGroundMessage(scene.ground, header));
  if (obstacles_.getNumSubscribers() > 0) obstacles_.publish(toObstaclesMessage(scene.obstacles, header));
}

}  // namespace dense_stereo
