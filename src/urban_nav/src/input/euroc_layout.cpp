// SPDX-License-Identifier: BSD-3-Clause
#include "input/euroc_layout.hpp"

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "input/image_file.hpp"
#include "urban_nav_core/io/calibration.hpp"
#include "urban_nav_core/io/csv.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_ros/extrinsics.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace urban_nav {

namespace fs = std::filesystem;
using urban_nav_core::CsvTable;
using urban_nav_core::Pose;
using urban_nav_core::RawCamera;
using urban_nav_core::RectifyMap;
using urban_nav_core::StampNs;
using urban_nav_core::UserError;
using urban_nav_core::Vector3d;

namespace {

constexpr StampNs kPairing = 5'000'000;  // ns between the two images of a pair

std::vector<std::pair<StampNs, std::string>> readImages(const std::string& camera) {
  const CsvTable table = CsvTable::read((fs::path(camera) / "data.csv").string());
  std::vector<std::pair<StampNs, std::string>> images;
  if (table.header().size() < 2)
    throw UserError(table.where(0), "has " + std::to_string(table.header().size()) + " columns",
                    "stamp in ns, file name");
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const fs::path name(table.text(row, 1));
    if (name.has_parent_path())
      throw UserError(table.where(row), "file name \"" + name.string() + "\"", "a name without folders");
    images.emplace_back(table.integer(row, 0), (fs::path(camera) / "data" / name).string());
  }
  return images;
}

}  // namespace

std::string eurocFolder(const std::string& path) {
  return fs::is_directory(fs::path(path) / "mav0") ? (fs::path(path) / "mav0").string() : path;
}

std::vector<EurocPair> readEurocPairs(const std::string& mav0) {
  const auto left = readImages((fs::path(mav0) / "cam0").string());
  const auto right = readImages((fs::path(mav0) / "cam1").string());
  std::vector<EurocPair> pairs;
  std::size_t j = 0;
  for (const auto& [stamp, path] : left) {
    for (; j < right.size() && right[j].first < stamp - kPairing; ++j)
      pairs.push_back({right[j].first, "", right[j].second});
    const bool partner = j < right.size() && std::abs(right[j].first - stamp) <= kPairing;
    pairs.push_back({stamp, path, partner ? right[j].second : ""});
    if (partner) ++j;
  }
  for (; j < right.size(); ++j) pairs.push_back({right[j].first, "", right[j].second});
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

std::vector<EurocImu> readEurocImu(const std::string& mav0) {
  const std::string path = (fs::path(mav0) / "imu0" / "data.csv").string();
  std::vector<EurocImu> rows;
  if (!fs::exists(path)) return rows;
  const CsvTable table = CsvTable::read(path);
  if (table.header().size() != 7)
    throw UserError(path, std::to_string(table.header().size()) + " columns",
                    "stamp in ns, three rates, three accelerations");
  for (std::size_t row = 0; row < table.rows(); ++row) {
    rows.push_back({table.integer(row, 0),
                    {table.number(row, 1), table.number(row, 2), table.number(row, 3)},
                    {table.number(row, 4), table.number(row, 5), table.number(row, 6)}});
  }
  return rows;
}

sensor_msgs::Imu toImuMessage(const EurocImu& row) {
  sensor_msgs::Imu message;
  message.header.stamp = urban_nav_ros::toRosTime(row.stamp);
  message.header.frame_id = urban_nav_core::frames::imu;
  message.angular_velocity.x = row.rate.x();
  message.angular_velocity.y = row.rate.y();
  message.angular_velocity.z = row.rate.z();
  message.linear_acceleration.x = row.acceleration.x();
  message.linear_acceleration.y = row.acceleration.y();
  message.linear_acceleration.z = row.acceleration.z();
  message.orientation_covariance[0] = -1.0;  // sensor_msgs/Imu: no orientation
  return message;
}

std::optional<urban_nav_core::Trajectory> readEurocTruth(const std::string& mav0, const Pose& T_base_body) {
  const std::string path = (fs::path(mav0) / "state_groundtruth_estimate0" / "data.csv").string();
  if (!fs::exists(path)) return std::nullopt;
  const CsvTable table = CsvTable::read(path);
  if (table.header().size() < 8)
    throw UserError(path, std::to_string(table.header().size()) + " columns",
                    "stamp in ns, position, quaternion w x y z");
  urban_nav_core::Trajectory trajectory;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const urban_nav_core::Quaterniond q(table.number(row, 4), table.number(row, 5), table.number(row, 6),
                                        table.number(row, 7));
    if (std::abs(q.norm() - 1.0) > 0.01)
      throw UserError(table.where(row), "quaternion of length " + std::to_string(q.norm()), "length 1");
    const Pose T_world_body(q, Vector3d(table.number(row, 1), table.number(row, 2), table.number(row, 3)));
    if (!trajectory.append(table.integer(row, 0), T_world_body * T_base_body.inverse()))
      throw UserError(table.where(row), "stamp is not later than the one before", "");
  }
  return trajectory;
}

urban_nav_ros::GreyImage readRectified(const std::string& path, const RectifyMap& map) {
  urban_nav_ros::GreyImage raw = readGrey(path);
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

}  // namespace urban_nav
