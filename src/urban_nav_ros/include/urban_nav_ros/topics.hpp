// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>

/// Names of topics, relative to the node's namespace unless they begin with a slash.
namespace urban_nav_ros::topics {

constexpr const char* kTransforms = "/tf";
constexpr const char* kStaticTransforms = "/tf_static";
constexpr const char* kClock = "/clock";

// Sensors.
constexpr const char* kLeftImage = "stereo/left/image_raw";
constexpr const char* kRightImage = "stereo/right/image_raw";
constexpr const char* kLeftRectified = "stereo/left/image_rect";
constexpr const char* kRightRectified = "stereo/right/image_rect";
constexpr const char* kLeftInfo = "stereo/left/camera_info";
constexpr const char* kRightInfo = "stereo/right/camera_info";
constexpr const char* kLaserLeft = "laser_left/scan";
constexpr const char* kLaserRight = "laser_right/scan";
constexpr const char* kScan = "scan";      // of the horizontal planar laser, and in the namespace of a laser
constexpr const char* kPoints = "points";  // of the 3D LiDAR
constexpr const char* kColourImage = "colour/image_raw/compressed";  // of converted folders
constexpr const char* kColourInfo = "colour/camera_info";
constexpr const char* kWheelOdometry = "wheel_odom";
constexpr const char* kVelocityCommand = "cmd_vel";
constexpr const char* kBattery = "battery";
constexpr const char* kImu = "imu/data";
constexpr const char* kMagneticField = "imu/mag";
constexpr const char* kGpsFix = "gps/fix";
constexpr const char* kGpsVelocity = "gps/vel";
constexpr const char* kPanoramaRaw = "ladybug/raw";
constexpr std::array<const char*, 5> kPanoramaImages = {"ladybug/camera0/image_raw", "ladybug/camera1/image_raw",
                                                        "ladybug/camera2/image_raw", "ladybug/camera3/image_raw",
                                                        "ladybug/camera4/image_raw"};
constexpr std::array<const char*, 5> kPanoramaInfos = {"ladybug/camera0/camera_info", "ladybug/camera1/camera_info",
                                                       "ladybug/camera2/camera_info", "ladybug/camera3/camera_info",
                                                       "ladybug/camera4/camera_info"};
constexpr std::array<const char*, 4> kDepthImages = {"depth0/image_raw", "depth1/image_raw", "depth2/image_raw",
                                                     "depth3/image_raw"};
constexpr std::array<const char*, 4> kDepthInfos = {"depth0/camera_info", "depth1/camera_info", "depth2/camera_info",
                                                    "depth3/camera_info"};

// Ground truth of recordings and of the simulator.
constexpr const char* kTruthPose = "ground_truth/pose";
constexpr const char* kTruthTransforms = "ground_truth/tf";

// Odometry of the robot as later stages receive it: launch files connect it to swf_vo or laser_odometry.
constexpr const char* kOdometry = "odometry";
constexpr const char* kRelativePose = "odometry/relative_pose";

// swf_vo.
constexpr const char* kVoOdometry = "vo/odometry";
constexpr const char* kVoRelativePose = "vo/relative_pose";
constexpr const char* kVoStatistics = "vo/statistics";
constexpr const char* kVoLandmarks = "vo/landmarks";
constexpr const char* kVoTracks = "vo/tracks";
constexpr const char* kVoPath = "vo/path";

// laser_odometry.
constexpr const char* kLoOdometry = "lo/odometry";
constexpr const char* kLoRelativePose = "lo/relative_pose";
constexpr const char* kLoLocalMap = "lo/local_map";
constexpr const char* kLoStatus = "lo/status";

// dense_stereo.
constexpr const char* kStereoDisparity = "stereo/disparity";
constexpr const char* kStereoPoints = "stereo/points2";
constexpr const char* kGroundPlane = "stereo/ground_plane";
constexpr const char* kObstacles = "stereo/obstacles";
constexpr const char* kDepthView = "stereo/depth_view";

// Place recognition.
constexpr const char* kPlaceBelief = "places/belief";
constexpr const char* kPlaceMarkers = "places/markers";

// Loop closures.
constexpr const char* kPlaceClosure = "places/closure";
constexpr const char* kMetricClosure = "loops/metric";
constexpr const char* kMapConstraints = "map/constraints";
constexpr const char* kClosureMatches = "loops/matches";

// laser_mapper.
constexpr const char* kMapCloud = "map/cloud";
constexpr const char* kMapTiles = "map/tiles";
constexpr const char* kMapQuality = "map/quality";
constexpr const char* kMapGrid = "map/grid";
constexpr const char* kMapTraversability = "map/traversability";
constexpr const char* kMapTerrain = "map/terrain";

// scene_labeler.
constexpr const char* kLabelImage = "labels/image";
constexpr const char* kLabelCloud = "labels/cloud";

// urban_nav_localization.
constexpr const char* kLocalizationState = "localization/state";
constexpr const char* kLocalizationPose = "localization/pose";
constexpr const char* kLocalizationHypothesis = "localization/hypothesis";
constexpr const char* kLocalizationMapPath = "localization/map_path";

// pose_graph.
constexpr const char* kGraphUpdate = "graph/update";
constexpr const char* kGraphCorrection = "graph/correction";
constexpr const char* kGraphPath = "graph/path";
constexpr const char* kGraphState = "graph/state";
constexpr const char* kGraphVerdicts = "graph/verdicts";
constexpr const char* kGraphMarkers = "graph/markers";

// urban_nav_trust.
constexpr const char* kTrustState = "trust/state";
constexpr const char* kTrustMarkers = "trust/markers";

// The operator.
constexpr const char* kInitialPose = "initialpose";
constexpr const char* kClickedPoint = "/clicked_point";  // of the tool publish_point of rviz

/// Topics of the recording that map --mcap and export --mcap write (docs/files.md).
namespace results {
constexpr const char* kOdometry = "/odometry";
constexpr const char* kStatus = "/status";
constexpr const char* kPath = "/path";
constexpr const char* kPoints = "/map/points";
constexpr const char* kClosures = "/closures";
constexpr const char* kClosureMarkers = "/closures/markers";
constexpr const char* kPlaces = "/places";
constexpr const char* kPlaceImages = "/places/image";
constexpr const char* kDiagnostics = "/diagnostics";
}  // namespace results

/// Returns the absolute name of a topic, as in recordings: "/imu/data".
inline std::string fromRoot(const std::string& topic) {
  return !topic.empty() && topic.front() == '/' ? topic : "/" + topic;
}

}  // namespace urban_nav_ros::topics
