// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/calibration.hpp"

#include <Eigen/LU>
#include <cmath>
#include <optional>

#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/io/yaml.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core {
namespace {

using Projection = Eigen::Matrix<double, 3, 4>;

constexpr double kLargestImage = 100000.0;  // px a side

int requireSize(const YamlNode& node, double value, std::string_view key, const std::string& file) {
  if (!(value >= 1.0) || value > kLargestImage || std::floor(value) != value) {
    throw UserError(atLine(file, node.line), std::string(key) + " = " + printNumber(value), "1...100000 (px)");
  }
  return static_cast<int>(value);
}

template <int Rows, int Columns>
Eigen::Matrix<double, Rows, Columns> requireMatrix(const YamlNode& node, std::string_view key,
                                                   const std::string& file) {
  const YamlNode& matrix = require(node, key, file);
  const auto numbers = requireNumbers(matrix, "data", static_cast<std::size_t>(Rows * Columns), file);
  return Eigen::Map<const Eigen::Matrix<double, Rows, Columns, Eigen::RowMajor>>(numbers.data());
}

void refuseUnlessRotation(const Matrix3d& R, const std::string& where, const std::string& what) {
  constexpr double kTolerance = 1e-3;
  const bool rotation =
      ((R * R.transpose() - Matrix3d::Identity()).array().abs() <= kTolerance).all() && R.determinant() > 0.0;
  if (!rotation) throw UserError(where, what + " is not a rotation", "");
}

Pose requireExtrinsics(const YamlNode& root, const std::string& file) {
  const Eigen::Matrix4d M = requireMatrix<4, 4>(root, "T_BS", file);
  refuseUnlessRotation(M.topLeftCorner<3, 3>(), atLine(file, require(root, "T_BS", file).line), "T_BS");
  return Pose(Matrix3d(M.topLeftCorner<3, 3>()), Vector3d(M.topRightCorner<3, 1>()));
}

/// Returns an optional non-negative number; 0 without the key.
double findNotNegative(const YamlNode& root, std::string_view key, const std::string& file) {
  if (root.find(key) == nullptr) return 0.0;
  const double value = requireNumber(root, key, file);
  if (value < 0.0)
    throw UserError(atLine(file, require(root, key, file).line), std::string(key) + " = " + printNumber(value),
                    "0 or more");
  return value;
}

std::vector<double> toNumbers(const YamlNode& node, std::string_view key, const std::string& file) {
  const YamlNode& list = require(node, key, file);
  return list.kind == YamlNode::Kind::List ? requireNumbers(node, key, list.list.size(), file) : std::vector<double>{};
}

// KITTI

std::optional<Projection> parseProjection(std::string_view line, std::string_view key, std::string_view raw_key,
                                          const std::string& where) {
  const std::size_t colon = line.find(':');
  const std::string_view name = trimmed(line.substr(0, colon));
  if (colon == std::string_view::npos || (name != key && name != raw_key)) return std::nullopt;
  const auto words = splitBlanks(line.substr(colon + 1));
  if (words.size() != 12)
    throw UserError(where, std::string(name) + " with " + std::to_string(words.size()) + " numbers",
                    "12: a 3x4 matrix, row by row");
  Projection P;
  for (int i = 0; i < 12; ++i) {
    const auto number = parseNumber(words[static_cast<std::size_t>(i)]);
    if (!number)
      throw UserError(where, std::string(name) + " holds `" + std::string(words[static_cast<std::size_t>(i)]) + "`",
                      "finite numbers");
    P(i / 4, i % 4) = *number;
  }
  return P;
}

CameraInfo makeInfo(const Projection& P, int width, int height) {
  CameraInfo info;
  info.width = width;
  info.height = height;
  info.K = P.leftCols<3>();
  info.P = P;
  return info;
}

std::string printProjection(const std::string& key, const StereoCamera& camera, double offset) {
  const Pinhole& c = camera.left;
  std::string line = key + ":";
  for (const double value : {c.fx, 0.0, c.cx, offset, 0.0, c.fy, c.cy, 0.0, 0.0, 0.0, 1.0, 0.0})
    line += " " + printNumber(value);
  return line + "\n";
}

// camera_info

template <typename Matrix>
std::string printMatrix(const std::string& key, const Matrix& M) {
  std::string text =
      key + ":\n  rows: " + std::to_string(M.rows()) + "\n  cols: " + std::to_string(M.cols()) + "\n  data: [";
  for (Eigen::Index i = 0; i < M.size(); ++i) text += (i == 0 ? "" : ", ") + printNumber(M(i / M.cols(), i % M.cols()));
  return text + "]\n";
}

}  // namespace

StereoCamera parseKittiCalibration(std::string_view text, const std::string& name, int width, int height,
                                   KittiPair pair) {
  const std::string a = pair == KittiPair::Grey ? "0" : "2", b = pair == KittiPair::Grey ? "1" : "3";
  std::optional<Projection> left, right;
  forEachLine(text, [&](std::string_view line, int number) {
    const std::string where = atLine(name, number);
    if (const auto P = parseProjection(line, "P" + a, "P_rect_0" + a, where)) left = P;
    if (const auto P = parseProjection(line, "P" + b, "P_rect_0" + b, where)) right = P;
  });
  if (!left || !right)
    throw UserError(name, "no line P" + (left ? b : a), "`P" + a + ": ` and `P" + b + ": ` with twelve numbers each");
  // The left camera need not be the origin of the rig: only the offset between the two is used.
  right->col(3) -= left->col(3);
  left->col(3).setZero();
  return stereoCamera(makeInfo(*left, width, height), makeInfo(*right, width, height), name);
}

std::optional<Vector3d> parseKittiOffset(std::string_view text, const std::string& name, KittiPair pair) {
  const std::string a = pair == KittiPair::Grey ? "0" : "2";
  std::optional<Projection> left;
  forEachLine(text, [&](std::string_view line, int number) {
    if (const auto P = parseProjection(line, "P" + a, "P_rect_0" + a, atLine(name, number))) left = P;
  });
  if (!left) return std::nullopt;
  const CameraInfo info = makeInfo(*left, 1, 1);
  (void)rectifiedPinhole(info, name);
  return Vector3d(info.K.inverse() * left->col(3));
}

StereoCamera readKittiCalibration(const std::string& path, int width, int height, KittiPair pair) {
  return parseKittiCalibration(readTextFile(path), path, width, height, pair);
}

std::string printKittiCalibration(const StereoCamera& camera) {
  return printProjection("P0", camera, 0.0) + printProjection("P1", camera, -camera.left.fx * camera.baseline);
}

CameraInfo parseCameraInfo(std::string_view text, const std::string& name) {
  const YamlNode root = parseYaml(text, name);
  CameraInfo info;
  info.width =
      requireSize(require(root, "image_width", name), requireNumber(root, "image_width", name), "image_width", name);
  info.height =
      requireSize(require(root, "image_height", name), requireNumber(root, "image_height", name), "image_height", name);
  const YamlNode* model = root.find("distortion_model");
  info.distortion_model = model != nullptr ? model->scalar : "";
  if (root.find("distortion_coefficients") != nullptr)
    info.D = toNumbers(require(root, "distortion_coefficients", name), "data", name);
  info.K = requireMatrix<3, 3>(root, "camera_matrix", name);
  if (root.find("rectification_matrix") != nullptr) info.R = requireMatrix<3, 3>(root, "rectification_matrix", name);
  if (info.R.isZero(0.0)) info.R.setIdentity();  // "not set", as in the message
  refuseUnlessRotation(info.R, name, "rectification_matrix");
  info.P = requireMatrix<3, 4>(root, "projection_matrix", name);
  (void)rawCamera(info, name);
  (void)rectifiedPinhole(info, name);
  return info;
}

CameraInfo readCameraInfo(const std::string& path) { return parseCameraInfo(readTextFile(path), path); }

std::string printCameraInfo(const CameraInfo& info, const std::string& camera_name) {
  const Eigen::Map<const Eigen::RowVectorXd> D(info.D.data(), static_cast<Eigen::Index>(info.D.size()));
  return "image_width: " + std::to_string(info.width) + "\nimage_height: " + std::to_string(info.height) +
         "\ncamera_name: " + camera_name + "\n" + printMatrix("camera_matrix", info.K) +
         "distortion_model: " + (info.distortion_model.empty() ? "plumb_bob" : info.distortion_model) + "\n" +
         printMatrix("distortion_coefficients", D) + printMatrix("rectification_matrix", info.R) +
         printMatrix("projection_matrix", info.P);
}

EurocCamera parseEurocCamera(std::string_view text, const std::string& name) {
  const YamlNode root = parseYaml(text, name);
  EurocCamera camera;
  camera.T_body_camera = requireExtrinsics(root, name);
  camera.rate_hz = findNotNegative(root, "rate_hz", name);
  const auto size = requireNumbers(root, "resolution", 2, name);
  camera.info.width = requireSize(require(root, "resolution", name), size[0], "resolution", name);
  camera.info.height = requireSize(require(root, "resolution", name), size[1], "resolution", name);
  const auto k = requireNumbers(root, "intrinsics", 4, name);
  camera.info.K << k[0], 0.0, k[2], 0.0, k[1], k[3], 0.0, 0.0, 1.0;
  camera.info.P.leftCols<3>() = camera.info.K;
  camera.info.distortion_model = require(root, "distortion_model", name).scalar;
  camera.info.D = toNumbers(root, "distortion_coefficients", name);
  (void)rawCamera(camera.info, name);
  return camera;
}

EurocCamera readEurocCamera(const std::string& path) { return parseEurocCamera(readTextFile(path), path); }

EurocImu parseEurocImu(std::string_view text, const std::string& name) {
  const YamlNode root = parseYaml(text, name);
  EurocImu imu;
  imu.T_body_imu = requireExtrinsics(root, name);
  imu.rate_hz = findNotNegative(root, "rate_hz", name);
  imu.gyroscope_noise = findNotNegative(root, "gyroscope_noise_density", name);
  imu.gyroscope_walk = findNotNegative(root, "gyroscope_random_walk", name);
  imu.accelerometer_noise = findNotNegative(root, "accelerometer_noise_density", name);
  imu.accelerometer_walk = findNotNegative(root, "accelerometer_random_walk", name);
  return imu;
}

EurocImu readEurocImu(const std::string& path) { return parseEurocImu(readTextFile(path), path); }

}  // namespace urban_nav_core
