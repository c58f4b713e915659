// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/stereo_calibration.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>

#include "urban_nav_core/camera/rectify.hpp"
#include "urban_nav_core/io/calibration.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/io/yaml.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core {
namespace {

constexpr double kLargestSize = 100000.0;  // px a side
constexpr double kSame = 1e-9;             // relative difference of equal numbers
constexpr const char* kFormats =
    "KITTI's calib.txt, Kalibr's camchain.yaml, ost.txt with both cameras, or LEFT,RIGHT: two files of camera_info, "
    "EuRoC's sensor.yaml or ost.txt";

bool beginsLine(std::string_view text, std::string_view words) {
  for (std::size_t at = text.find(words); at != std::string_view::npos; at = text.find(words, at + 1))
    if (at == 0 || text[at - 1] == '\n' || text[at - 1] == '\r') return true;
  return false;
}

int toSize(double value, const std::string& what, const std::string& where) {
  if (!(value >= 1.0) || value > kLargestSize || std::floor(value) != value)
    throw UserError(where, what + " = " + printNumber(value), "1...100000 (px)");
  return static_cast<int>(value);
}

Pose toPose(const Eigen::Matrix4d& M, const std::string& what, const std::string& where) {
  constexpr double kTolerance = 1e-3;
  const Matrix3d R = M.topLeftCorner<3, 3>();
  const bool rotates =
      ((R * R.transpose() - Matrix3d::Identity()).array().abs() <= kTolerance).all() && R.determinant() > 0.0;
  if (!rotates) throw UserError(where, what + " is not a rigid transform", "a rotation and a translation");
  return Pose(R, Vector3d(M.topRightCorner<3, 1>()));
}

// Kalibr

/// Returns a 4x4 matrix given as a list of four rows; nullopt without the key.
std::optional<Pose> findTransform(const YamlNode& camera, const char* key, const std::string& name) {
  const YamlNode* rows = camera.find(key);
  if (rows == nullptr) return std::nullopt;
  const std::string where = atLine(name, rows->line);
  if (rows->list.size() != 4) throw UserError(where, std::string(key) + " does not have four rows", "a 4x4 matrix");
  Eigen::Matrix4d M;
  for (std::size_t i = 0; i < 4; ++i) {
    const YamlNode& row = rows->list[i];
    if (row.list.size() != 4) throw UserError(atLine(name, row.line), "a row without four numbers", "a 4x4 matrix");
    for (std::size_t j = 0; j < 4; ++j) {
      const auto number = parseNumber(row.list[j].scalar);
      if (!number) throw UserError(atLine(name, row.line), "`" + row.list[j].scalar + "`", "a finite number");
      M(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = *number;
    }
  }
  return toPose(M, key, where);
}

CameraInfo readKalibrCamera(const YamlNode& camera, const std::string& name) {
  const YamlNode& model = require(camera, "camera_model", name);
  if (model.scalar != "pinhole")
    throw UserError(atLine(name, model.line), "camera_model = " + model.scalar,
                    "pinhole (calibrate with pinhole-radtan)");
  const auto size = requireNumbers(camera, "resolution", 2, name);
  const std::string where = atLine(name, require(camera, "resolution", name).line);
  CameraInfo info;
  info.width = toSize(size[0], "resolution", where);
  info.height = toSize(size[1], "resolution", where);
  const auto k = requireNumbers(camera, "intrinsics", 4, name);
  info.K << k[0], 0.0, k[2], 0.0, k[1], k[3], 0.0, 0.0, 1.0;
  const YamlNode* distortion = camera.find("distortion_model");
  if (distortion == nullptr || distortion->scalar == "none") return info;
  info.distortion_model = distortion->scalar == "radtan" ? "plumb_bob"
                          : distortion->scalar == "equi" ? "equidistant"
                                                         : distortion->scalar;
  const YamlNode& coefficients = require(camera, "distortion_coeffs", name);
  info.D = requireNumbers(camera, "distortion_coeffs", coefficients.list.size(), name);
  return info;
}

// ost.txt

/// Reads the lines of an ost.txt in sequence; blank lines and comments are skipped.
class OstLines {
 public:
  OstLines(std::string_view text, std::string name) : name_(std::move(name)) {
    forEachLine(text, [this](std::string_view line, int number) {
      const std::string_view content = trimmed(line);
      if (!content.empty() && content.front() != '#') lines_.emplace_back(content, number);
    });
  }

  bool isAtEnd() const { return at_ == lines_.size(); }
  std::string_view take() {
    if (isAtEnd()) throw UserError(name_, "ends early", "a complete ost.txt");
    return lines_[at_++].first;
  }
  std::string where() const { return atLine(name_, at_ > 0 ? lines_[at_ - 1].second : 0); }

  std::vector<double> takeNumbers() {
    std::vector<double> numbers;
    for (const std::string_view word : splitBlanks(take())) {
      const auto number = parseNumber(word);
      if (!number) throw UserError(where(), "`" + std::string(word) + "`", "a finite number");
      numbers.push_back(*number);
    }
    return numbers;
  }

  template <int Rows, int Columns>
  Eigen::Matrix<double, Rows, Columns> takeMatrix() {
    Eigen::Matrix<double, Rows, Columns> M;
    for (int i = 0; i < Rows; ++i) {
      const std::vector<double> row = takeNumbers();
      if (row.size() != static_cast<std::size_t>(Columns))
        throw UserError(where(), std::to_string(row.size()) + " numbers in a row", std::to_string(Columns));
      for (int j = 0; j < Columns; ++j) M(i, j) = row[static_cast<std::size_t>(j)];
    }
    return M;
  }

 private:
  std::string name_;
  std::vector<std::pair<std::string_view, int>> lines_;
  std::size_t at_ = 0;
};

CameraInfo readOne(const std::string& text, const std::string& name, CalibrationKind kind) {
  if (kind == CalibrationKind::CameraInfo) return parseCameraInfo(text, name);
  const std::vector<CameraInfo> cameras = parseOst(text, name);
  if (cameras.size() != 1)
    throw UserError(name, std::to_string(cameras.size()) + " cameras", "one in each of two files, or both in one file");
  return cameras.front();
}

}  // namespace

CalibrationKind calibrationKind(std::string_view text) {
  if (beginsLine(text, "[image]")) return CalibrationKind::Ost;
  if (beginsLine(text, "cam0:")) return CalibrationKind::Camchain;
  if (beginsLine(text, "T_BS:")) return CalibrationKind::Euroc;
  if (beginsLine(text, "image_width:") || beginsLine(text, "camera_matrix:")) return CalibrationKind::CameraInfo;
  return CalibrationKind::Other;
}

CameraPair parseStereoCalibration(const std::vector<std::string>& texts, const std::vector<std::string>& names) {
  const CalibrationKind kind = calibrationKind(texts.front());
  if (texts.size() == 1 && kind == CalibrationKind::Camchain) return parseCamchain(texts.front(), names.front());
  if (texts.size() == 1 && kind == CalibrationKind::Ost) {
    const std::vector<CameraInfo> cameras = parseOst(texts.front(), names.front());
    if (cameras.size() != 2)
      throw UserError(names.front(), std::to_string(cameras.size()) + " camera", "two, or LEFT,RIGHT: a file for each");
    return {cameras[0], cameras[1]};
  }
  if (texts.size() != 2) throw UserError(names.front(), "is a file of one camera, or of an unknown kind", kFormats);
  const CalibrationKind other = calibrationKind(texts.back());
  if (kind != other) throw UserError(names.back(), "is not of the same kind as " + names.front(), kFormats);
  if (kind == CalibrationKind::Euroc) {
    const EurocCamera left = parseEurocCamera(texts.front(), names.front()),
                      right = parseEurocCamera(texts.back(), names.back());
    return rectifiedPair(left.info, right.info, right.T_body_camera.inverse() * left.T_body_camera, names.back());
  }
  if (kind == CalibrationKind::Camchain || kind == CalibrationKind::Other)
    throw UserError(names.front(), "is not a known calibration file of one camera", kFormats);
  return {readOne(texts.front(), names.front(), kind), readOne(texts.back(), names.back(), kind)};
}

std::vector<CameraInfo> parseOst(std::string_view text, const std::string& name) {
  OstLines lines(text, name);
  std::vector<CameraInfo> cameras;
  int width = 0, height = 0;
  while (!lines.isAtEnd()) {
    const std::string_view key = lines.take();
    if (key == "width" || key == "height") {
      const std::vector<double> value = lines.takeNumbers();
      if (value.size() != 1) throw UserError(lines.where(), "not a number", "the " + std::string(key) + " in px");
      (key == "width" ? width : height) = toSize(value.front(), std::string(key), lines.where());
    } else if (key == "camera matrix") {
      cameras.emplace_back();
      cameras.back().width = width;
      cameras.back().height = height;
      cameras.back().K = lines.takeMatrix<3, 3>();
    } else if (key.front() != '[') {
      if (cameras.empty()) throw UserError(lines.where(), "`" + std::string(key) + "`", "`camera matrix` first");
      if (key == "distortion") cameras.back().D = lines.takeNumbers();
      else if (key == "rectification") cameras.back().R = lines.takeMatrix<3, 3>();
      else if (key == "projection") cameras.back().P = lines.takeMatrix<3, 4>();
      else
        throw UserError(lines.where(), "`" + std::string(key) + "`",
                        "camera matrix, distortion, rectification, projection");
    }
  }
  for (CameraInfo& info : cameras) {
    info.distortion_model = info.D.size() > 5 ? "rational_polynomial" : "plumb_bob";  // the format does not name it
    (void)rawCamera(info, name);
    (void)rectifiedPinhole(info, name);
  }
  if (cameras.empty()) throw UserError(name, "has no `camera matrix`", "a complete ost.txt");
  return cameras;
}

CameraPair parseCamchain(std::string_view text, const std::string& name) {
  const YamlNode root = parseYaml(text, name);
  const YamlNode &left = require(root, "cam0", name), &right = require(root, "cam1", name);
  std::optional<Pose> T_right_left = findTransform(right, "T_cn_cnm1", name);
  if (!T_right_left) {
    const auto T_left_imu = findTransform(left, "T_cam_imu", name),
               T_right_imu = findTransform(right, "T_cam_imu", name);
    if (!T_left_imu || !T_right_imu)
      throw UserError(atLine(name, right.line), "cam1 has no T_cn_cnm1", "the transform from cam0 to cam1");
    T_right_left = *T_right_imu * T_left_imu->inverse();
  }
  return rectifiedPair(readKalibrCamera(left, name), readKalibrCamera(right, name), *T_right_left, name);
}

CameraPair rectifiedPair(const CameraInfo& left, const CameraInfo& right, const Pose& T_right_left,
                         const std::string& where) {
  CameraPair pair{left, right};
  const RawCamera left_raw = rawCamera(left, where), right_raw = rawCamera(right, where);
  const Vector3d t = T_right_left.t();
  const bool is_rectified = left_raw.distortion.isNone() && right_raw.distortion.isNone() &&
                            left.K.isApprox(right.K, kSame) && T_right_left.R().isIdentity(kSame) && t.x() < 0.0 &&
                            t.tail<2>().norm() <= kSame * t.norm() && left.width == right.width &&
                            left.height == right.height;
  for (CameraInfo* info : {&pair.first, &pair.second}) {
    info->R.setIdentity();
    info->P.setZero();
    info->P.leftCols<3>() = info->K;
  }
  double baseline = -t.x();
  if (!is_rectified) {
    const StereoRectification rectification = rectifyStereo(left_raw, right_raw, T_right_left, where);
    const Pinhole& pinhole = rectification.camera.left;
    pair.first.R = rectification.R_left;
    pair.second.R = rectification.R_right;
    for (CameraInfo* info : {&pair.first, &pair.second})
      info->P.leftCols<3>() << pinhole.fx, 0.0, pinhole.cx, 0.0, pinhole.fy, pinhole.cy, 0.0, 0.0, 1.0;
    baseline = rectification.camera.baseline;
  }
  pair.second.P(0, 3) = -pair.second.P(0, 0) * baseline;
  return pair;
}

}  // namespace urban_nav_core
