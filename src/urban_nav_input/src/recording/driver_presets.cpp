// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/recording/driver_presets.hpp"

#include <algorithm>

#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/io/text.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_input {
namespace {

constexpr double kStandardGravity = 9.80665;  // m/s2, CGPM 1901

std::vector<DriverPreset> makeLidarPresets() {
  return {
      {"livox",
       "livox_ros_driver, livox_ros_driver2 (Mid-40, Mid-70, Avia, Horizon, Mid-360, HAP)",
       "Livox-SDK/livox_ros_driver2, README.md and src/lddc.cpp",
       {{"points", {"livox/lidar*"}}, {"imu", {"livox/imu*"}, false}},
       {},
       {{"accelerometer_scale", kStandardGravity}},  // accelerations in g
       "livox_frame"},
      {"ouster",
       "ouster-ros, ouster_example (OS0, OS1, OS2)",
       "ouster-lidar/ouster-ros, README.md; default_imu_to_sensor_transform and the like of ouster-sdk",
       {{"points", {"ouster/points", "os_cloud_node/points", "os1_cloud_node/points"}},
        {"imu", {"ouster/imu", "os_cloud_node/imu", "os1_cloud_node/imu"}, false}},
       {},
       {},
       "os_sensor",
       {{"os_sensor", "os_lidar", 0.0, 0.0, 0.03618, 0.0, 0.0, 1.0, 0.0},
        {"os_sensor", "os_imu", 0.006253, -0.011775, 0.007645}}},
      {"sick",
       "sick_scan_xd, sick_scan (TiM, LMS, MRS, multiScan, picoScan)",
       "SICKAG/sick_scan_xd, README.md and launch/*.launch",
       {{"laser_left", {"scan", "scan_fullframe"}, false},
        {"points", {"cloud_all_fields_fullframe", "cloud_unstructured_fullframe", "cloud"}, false},
        {"imu", {"sick_mrs_1xxx/imu", "sick_multiscan/imu", "sick_scan_xd/imu", "multiScan/imu"}, false}},
       {"laser_left", "points"},
       {},
       "cloud"},
      {"velodyne",
       "velodyne_pointcloud (VLP-16, VLP-32C, HDL-32E, HDL-64E, VLS-128)",
       "ros-drivers/velodyne, velodyne_pointcloud/README.md",
       {{"points", {"velodyne_points"}}},
       {},
       {},
       "velodyne"},
  };
}

std::vector<DriverPreset> makeCameraPresets() {
  return {
      {"realsense",
       "realsense2_camera (D415, D435, D435i, D455, D456): the two infrared cameras",
       "IntelRealSense/realsense-ros, README.md",
       {{"left", {"infra1/image_rect_raw"}},
        {"right", {"infra2/image_rect_raw"}},
        {"left_info", {"infra1/camera_info"}},
        {"right_info", {"infra2/camera_info"}},
        {"depth0", {"depth/image_rect_raw"}, false},
        {"imu", {"camera/imu"}, false}},
       {},
       {},
       "camera_link"},
      {"zed",
       "zed_wrapper (ZED, ZED Mini, ZED 2, ZED 2i, ZED X)",
       "stereolabs/zed-ros-wrapper and zed-ros2-wrapper, README.md",
       // camera_info is in the folder of the images
       {{"left",
         {"left/image_rect_gray", "left_gray/image_rect_gray", "left/gray/rect/image", "left/image_rect_color",
          "left/color/rect/image", "left_raw/image_raw_gray", "left_raw/image_raw_color", "left_raw/image_raw"}},
        {"right",
         {"right/image_rect_gray", "right_gray/image_rect_gray", "right/gray/rect/image", "right/image_rect_color",
          "right/color/rect/image", "right_raw/image_raw_gray", "right_raw/image_raw_color", "right_raw/image_raw"}},
        {"depth0", {"depth/depth_registered"}, false},
        {"imu", {"zed_node/imu/data"}, false}},
       {},
       {},
       "zed_camera_link"},
  };
}

std::vector<DriverPreset> makeReceiverPresets() {
  return {
      {"ublox",
       "ublox_gps, ublox_dgnss",
       "KumarRobotics/ublox, ublox_gps/README.md",
       {{"gps", {"ublox/fix", "ublox_gps/fix", "ublox_gps_node/fix", "fix"}}},
       {},
       {},
       ""},
  };
}

std::vector<DriverPreset> makeDriverPresets() {
  std::vector<DriverPreset> all = makeLidarPresets();
  for (const auto& more : {makeCameraPresets(), makeReceiverPresets()}) all.insert(all.end(), more.begin(), more.end());
  std::sort(all.begin(), all.end(),
            [](const DriverPreset& a, const DriverPreset& b) { return std::string_view(a.name) < b.name; });
  return all;
}

}  // namespace

const std::vector<DriverPreset>& driverPresets() {
  static const std::vector<DriverPreset> presets = makeDriverPresets();
  return presets;
}

std::vector<std::string> driverPresetNames() {
  std::vector<std::string> names;
  for (const DriverPreset& preset : driverPresets()) names.emplace_back(preset.name);
  return names;
}

const DriverPreset& findDriverPreset(const std::string& name) {
  const std::vector<DriverPreset>& presets = driverPresets();
  const auto found =
      std::find_if(presets.begin(), presets.end(), [&](const DriverPreset& preset) { return name == preset.name; });
  if (found == presets.end())
    throw urban_nav_core::UserError("--preset", "\"" + name + "\"", urban_nav_core::joined(driverPresetNames()));
  return *found;
}

bool hasPresetName(const std::string& topic, std::string_view name) {
  std::string_view text = topic;
  constexpr std::string_view kCompressed = "/compressed";
  if (text.size() > kCompressed.size() && text.substr(text.size() - kCompressed.size()) == kCompressed)
    text.remove_suffix(kCompressed.size());
  if (!name.empty() && name.back() == '*') {
    name.remove_suffix(1);
    const std::size_t last = text.rfind('/'), in_name = name.rfind('/');
    const std::size_t part = name.size() - (in_name == std::string_view::npos ? 0 : in_name + 1);
    const std::size_t begin = last == std::string_view::npos ? 0 : last + 1;
    if (text.size() < begin + part) return false;
    text = text.substr(0, begin + part);  // the rest of the last part may be anything
  }
  if (text.size() < name.size() || text.substr(text.size() - name.size()) != name) return false;
  return text.size() == name.size() || text[text.size() - name.size() - 1] == '/';
}

std::vector<std::string> presetTransforms(const DriverPreset& preset) {
  std::vector<std::string> texts;
  for (const PresetTransform& one : preset.transforms) {
    std::string text = std::string("?") + one.parent + "," + one.child + ":";
    for (const double value : {one.x, one.y, one.z, one.qx, one.qy, one.qz, one.qw})
      text += (text.back() == ':' ? "" : ",") + urban_nav_core::printNumber(value);
    texts.push_back(text);
  }
  if (*preset.base_frame != '\0') texts.push_back(std::string("?base_link,") + preset.base_frame + ":0,0,0,0,0,0,1");
  return texts;
}

}  // namespace urban_nav_input
