// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Names of topics, relative to the node's namespace unless they begin with a slash.
namespace urban_nav_ros::topics {

constexpr const char* kStaticTransforms = "/tf_static";

// Sensors.
constexpr const char* kLeftImage = "stereo/left/image_raw";
constexpr const char* kRightImage = "stereo/right/image_raw";
constexpr const char* kLeftRectified = "stereo/left/image_rect";
constexpr const char* kRightRectified = "stereo/right/image_rect";
constexpr const char* kLeftInfo = "stereo/left/camera_info";
constexpr const char* kRightInfo = "stereo/right/camera_info";
constexpr const char* kLaserLeft = "laser_left/scan";
constexpr const char* kLaserRight = "laser_right/scan";
constexpr const char* kWheelOdometry = "wheel_odom";
constexpr const char* kImu = "imu/data";
constexpr const char* kGpsFix = "gps/fix";

// swf_vo.
constexpr const char* kVoOdometry = "vo/odometry";
constexpr const char* kVoRelativePose = "vo/relative_pose";
constexpr const char* kVoFrame = "vo/frame";
constexpr const char* kVoLandmarks = "vo/landmarks";
constexpr const char* kVoTracks = "vo/tracks";
constexpr const char* kVoPath = "vo/path";

// dense_stereo.
constexpr const char* kStereoDisparity = "stereo/disparity";
constexpr const char* kStereoPoints = "stereo/points2";
constexpr const char* kGroundPlane = "stereo/ground_plane";
constexpr const char* kObstacles = "stereo/obstacles";

// Place recognition.
constexpr const char* kPlaceBelief = "places/belief";
constexpr const char* kPlaceMarkers = "places/markers";

// Loop closures.
constexpr const char* kPlaceClosure = "places/closure";
constexpr const char* kMetricClosure = "loops/metric";
constexpr const char* kMapConstraints = "map/constraints";

// pose_graph.
constexpr const char* kGraphUpdate = "graph/update";
constexpr const char* kGraphJump = "graph/jump";
constexpr const char* kGraphPath = "graph/path";
constexpr const char* kGraphState = "graph/state";
constexpr const char* kGraphMarkers = "graph/markers";

// The operator.
constexpr const char* kInitialPose = "initialpose";

}  // namespace urban_nav_ros::topics
