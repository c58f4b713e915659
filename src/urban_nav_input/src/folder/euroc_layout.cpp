// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/folder/euroc_layout.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "folder/euroc_table.hpp"
#include "urban_nav_core/io/calibration.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_input/folder/image_file.hpp"
#include "urban_nav_ros/extrinsics.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_input {

namespace fs = std::filesystem;
using urban_nav_core::Pose;
using urban_nav_core::RawCamera;
using urban_nav_core::RectifyMap;
using urban_nav_core::StampNs;
using urban_nav_core::UserError;
using urban_nav_core::Vector3d;

namespace {

/// Returns the images of a camera in order of stamps, without later ones of the same stamp.
std::vector<std::pair<StampNs, std::string>> readImages(const std::string& camera, std::vector<std::string>* notes) {
  const std::string path = (fs::path(camera) / "data.csv").string();
  const EurocTable table = readEurocTable(path, 2, "stamp in ns, file name");
  if (notes != nullptr && table.out_of_order > 0)
    notes->push_back(path + ": " + std::to_string(table.out_of_order) + " rows out of order, sorted by stamp");
  if (notes != nullptr && table.unit == 1.0) notes->push_back(path + ": its stamps are in seconds, not ns");
  if (notes != nullptr && table.repeated > 0)
    notes->push_back(path + ": " + std::to_string(table.repeated) + " rows left out: an earlier one has their stamp");
  std::vector<std::pair<StampNs, std::string>> images;
  for (const EurocRow& row : table.rows) {
    const fs::path name(row.cells[1]);
    const fs::path folder = name.parent_path();
    if (!folder.empty() && folder != "data" && folder != "./data" && folder != ".")
      throw UserError(row.where, "file name \"" + name.string() + "\"",
                      "a name without folders, or data/NAME: images are in " + (fs::path(camera) / "data").string());
    images.emplace_back(row.stamp, (fs::path(camera) / "data" / name.filename()).string());
  }
  return images;
}

}  // namespace

std::string eurocFolder(const std::string& path) {
  return fs::is_directory(fs::path(path) / "mav0") ? (fs::path(path) / "mav0").string() : path;
}

std::vector<EurocPair> readEurocPairs(const std::string& mav0, std::vector<std::string>* notes,
                                      const PairingConvention& pairing) {
  const auto left = readImages((fs::path(mav0) / "cam0").string(), notes);
  auto right = readImages((fs::path(mav0) / "cam1").string(), notes);
  for (auto& [stamp, path] : right) stamp -= pairing.right_delay;
  std::vector<EurocPair> pairs;
  std::size_t j = 0;
  for (const auto& [stamp, path] : left) {
    for (; j < right.size() && right[j].first < stamp - pairing.tolerance; ++j)
      pairs.push_back({right[j].first, "", right[j].second, right[j].first + pairing.right_delay});
    const bool partner = j < right.size() && std::abs(right[j].first - stamp) <= pairing.tolerance;
    pairs.push_back({stamp, path, partner ? right[j].second : "", partner ? right[j].first + pairing.right_delay : 0});
    if (partner) ++j;
  }
  for (; j < right.size(); ++j)
    pairs.push_back({right[j].first, "", right[j].second, right[j].first + pairing.right_delay});
  return pairs;
}

EurocRig readEurocRig(const std::string& mav0) {
  const std::string left_path = (fs::path(mav0) / "cam0" / "sensor.yaml").string(),
                    right_path = (fs::path(mav0) / "cam1" / "sensor.yaml").string();
  const urban_nav_core::EurocCamera left = urban_nav_core::readEurocCamera(left_path),
                                    right = urban_nav_core::readEurocCamera(right_path);
  const RawCamera left_raw = urban_nav_core::rawCamera(left.info, left_path),
                  right_raw = urban_nav_core::rawCamera(right.info, right_path);
  const Pose T_right_left = right.T_body_camera.inverse() * left.T_body_camera;
  const urban_nav_core::StereoRectification rectification =
      urban_nav_core::rectifyStereo(left_raw, right_raw, T_right_left, mav0);
  const urban_nav_core::Pinhole& rectified = rectification.camera.left;
  const Pose T_base_camera = urban_nav_ros::opticalInBody();
  const Pose T_camera_raw(rectification.R_left, Vector3d::Zero());
  return {left_raw,
          right_raw,
          rectification,
          RectifyMap(left_raw, rectification.R_left, rectified),
          RectifyMap(right_raw, rectification.R_right, rectified),
          T_base_camera,
          T_base_camera * T_camera_raw * left.T_body_camera.inverse()};
}

namespace {

/// Returns the standard deviation of one rate, rad/s; 0 if not stated in the folder.
double readRateSigma(const std::string& mav0) {
  const std::string path = (fs::path(mav0) / "imu0" / "sensor.yaml").string();
  if (!fs::exists(path)) return 0.0;
  try {
    const urban_nav_core::EurocImu imu = urban_nav_core::readEurocImu(path);
    return imu.gyroscope_noise * std::sqrt(imu.rate_hz);
  } catch (const urban_nav_core::Error&) {
    return 0.0;  // then estimated from the rates
  }
}

}  // namespace

std::vector<EurocImu> readEurocImu(const std::string& mav0) {
  const std::string path = (fs::path(mav0) / "imu0" / "data.csv").string();
  std::vector<EurocImu> rows;
  if (!fs::exists(path)) return rows;
  const double rate_sigma = readRateSigma(mav0);
  for (const EurocRow& row : readEurocTable(path, 7, "stamp in ns, three rates, three accelerations").rows)
    rows.push_back({row.stamp,
                    {row.number(1), row.number(2), row.number(3)},
                    {row.number(4), row.number(5), row.number(6)},
                    rate_sigma});
  return rows;
}

sensor_msgs::Imu toImuMessage(const EurocImu& row) {
  sensor_msgs::Imu message;
  message.header.stamp = urban_nav_ros::toRosTime(row.stamp);
  message.header.frame_id = urban_nav_core::frames::kImu;
  message.angular_velocity.x = row.rate.x();
  message.angular_velocity.y = row.rate.y();
  message.angular_velocity.z = row.rate.z();
  for (const std::size_t i : {0U, 4U, 8U}) message.angular_velocity_covariance[i] = row.rate_sigma * row.rate_sigma;
  message.linear_acceleration.x = row.acceleration.x();
  message.linear_acceleration.y = row.acceleration.y();
  message.linear_acceleration.z = row.acceleration.z();
  message.orientation_covariance[0] = -1.0;  // sensor_msgs/Imu: no orientation
  return message;
}

std::optional<urban_nav_core::Trajectory> readEurocTruth(const std::string& mav0, const Pose& T_base_body) {
  const std::string path = (fs::path(mav0) / "state_groundtruth_estimate0" / "data.csv").string();
  if (!fs::exists(path)) return std::nullopt;
  urban_nav_core::Trajectory trajectory;
  for (const EurocRow& row : readEurocTable(path, 8, "stamp in ns, position, quaternion w x y z").rows) {
    const urban_nav_core::Quaterniond q(row.number(4), row.number(5), row.number(6), row.number(7));
    if (std::abs(q.norm() - 1.0) > 0.01)
      throw UserError(row.where, "quaternion of length " + std::to_string(q.norm()), "length 1");
    const Pose T_world_body(q, Vector3d(row.number(1), row.number(2), row.number(3)));
    trajectory.append(row.stamp, T_world_body * T_base_body.inverse());
  }
  return trajectory;
}

urban_nav_ros::GreyScale eurocScale(const std::vector<EurocPair>& pairs) {
  constexpr std::size_t kSampledImages = 20;  // pairs at the beginning, until the exposure has settled
  std::vector<std::string> paths;
  for (std::size_t i = 0; i < std::min(kSampledImages, pairs.size()); ++i)
    for (const std::string& path : {pairs[i].left, pairs[i].right})
      if (!path.empty()) paths.push_back(path);
  return sampleGreyScale(paths);
}

urban_nav_ros::GreyImage readRectified(const std::string& path, const RectifyMap& map,
                                       const urban_nav_ros::GreyScale& scale) {
  urban_nav_ros::GreyImage raw = readGrey(path, scale);
  if (raw.pixels.empty()) return raw;
  std::vector<std::uint8_t> bytes;
  const urban_nav_core::ImageView view = map.remap(urban_nav_ros::toView(raw.pixels), bytes);
  if (view.empty()) {
    return {{},
            path + ": " + std::to_string(raw.pixels.cols) + "x" + std::to_string(raw.pixels.rows) +
                " pixels, which is not the size in sensor.yaml"};
  }
  return {cv::Mat(view.height, view.width, CV_8UC1, bytes.data(), static_cast<std::size_t>(view.stride)).clone(), {}};
}

}  // namespace urban_nav_input
