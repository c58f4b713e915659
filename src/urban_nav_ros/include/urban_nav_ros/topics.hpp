// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Names of topics, relative to the node's namespace unless they begin with a slash.
namespace urban_nav_ros::topics {

constexpr const char* static_transforms = "/tf_static";

// Sensors.
constexpr const char* left_image = "stereo/left/image_raw";
constexpr const char* right_image = "stereo/right/image_raw";
constexpr const char* left_rectified = "stereo/left/image_rect";
constexpr const char* right_rectified = "stereo/right/image_rect";
constexpr const char* left_info = "stereo/left/camera_info";
constexpr const char* right_info = "stereo/right/camera_info";
constexpr const char* laser_left = "laser_left/scan";
constexpr const char* laser_right = "laser_right/scan";
constexpr const char* wheel_odometry = "wheel_odom";
constexpr const char* imu = "imu/data";
constexpr const char* gps_fix = "gps/fix";

// swf_vo.
constexpr const char* vo_odometry = "vo/odometry";
constexpr const char* vo_relative_pose = "vo/relative_pose";
constexpr const char* vo_frame = "vo/frame";
constexpr const char* vo_landmarks = "vo/landmarks";
constexpr const char* vo_tracks = "vo/tracks";
constexpr const char* vo_path = "vo/path";

// dense_stereo.
constexpr const char* stereo_disparity = "stereo/disparity";
constexpr const char* stereo_points = "stereo/points2";
constexpr const char* ground_plane = "stereo/ground_plane";
constexpr const char* obstacles = "stereo/obstacles";

// Place recognition.
constexpr const char* place_belief = "places/belief";
constexpr const char* place_markers = "places/markers";

// Loop closures.
constexpr const char* place_closure = "places/closure";
constexpr const char* metric_closure = "loops/metric";
constexpr const char* map_constraints = "map/constraints";

// pose_graph.
constexpr const char* graph_update = "graph/update";
constexpr const char* graph_jump = "graph/jump";
constexpr const char* graph_path = "graph/path";
constexpr const char* graph_state = "graph/state";
constexpr const char* graph_markers = "graph/markers";

// The operator.
constexpr const char* initial_pose = "initialpose";

}  // namespace urban_nav_ros::topics
