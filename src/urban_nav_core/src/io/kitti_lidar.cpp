// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/kitti_lidar.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <vector>

#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_core {

namespace {

using RowMajor3x3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
using RowMajor3x4 = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;

/// Row `KEY: NUMBER ...` of a calibration file.
struct CalibrationRow {
  std::string where;
  std::vector<double> numbers;
};

std::optional<CalibrationRow> findCalibrationRow(std::string_view text, const std::string& name,
                                                 const std::vector<std::string>& keys, std::size_t count) {
  std::optional<CalibrationRow> found;
  forEachLine(text, [&](std::string_view line, int number) {
    const std::size_t colon = line.find(':');
    const std::string key(trimmed(line.substr(0, colon)));
    if (found || colon == std::string_view::npos || std::find(keys.begin(), keys.end(), key) == keys.end()) return;
    CalibrationRow row{atLine(name, number), {}};
    for (const std::string_view word : splitBlanks(line.substr(colon + 1))) {
      const auto value = parseNumber(word);
      if (!value) throw UserError(row.where, key + " holds `" + std::string(word) + "`", "finite numbers");
      row.numbers.push_back(*value);
    }
    if (row.numbers.size() != count)
      throw UserError(row.where, key + " with " + std::to_string(row.numbers.size()) + " numbers",
                      std::to_string(count) + " numbers");
    found = std::move(row);
  });
  return found;
}

Matrix3d requireRotation(const Matrix3d& R, const std::string& where) {
  constexpr double kTolerance = 1e-3;
  if (!((R * R.transpose() - Matrix3d::Identity()).array().abs() <= kTolerance).all() || !(R.determinant() > 0.0))
    throw UserError(where, "a matrix that is not a rotation (tolerance 0.001)", "");
  return R;
}

}  // namespace

std::optional<Pose> parseKittiTr(std::string_view text, const std::string& name) {
  const std::optional<CalibrationRow> row = findCalibrationRow(text, name, {"Tr", "Tr_velo_to_cam", "Tr_velo_cam"}, 12);
  if (!row) return std::nullopt;
  const Eigen::Map<const RowMajor3x4> M(row->numbers.data());
  return Pose(requireRotation(M.leftCols<3>(), row->where), Vector3d(M.col(3)));
}

Pose parseKittiVeloToCam(std::string_view text, const std::string& name) {
  const std::optional<CalibrationRow> R = findCalibrationRow(text, name, {"R"}, 9),
                                      t = findCalibrationRow(text, name, {"T"}, 3);
  if (!R || !t)
    throw UserError(name, std::string("no line ") + (R ? "T" : "R"), "`R: ` with nine and `T: ` with three numbers");
  const Eigen::Map<const RowMajor3x3> M(R->numbers.data());
  return Pose(requireRotation(M, R->where), Vector3d(t->numbers[0], t->numbers[1], t->numbers[2]));
}

std::optional<Matrix3d> parseKittiRectification(std::string_view text, const std::string& name) {
  const std::optional<CalibrationRow> row = findCalibrationRow(text, name, {"R_rect_00"}, 9);
  if (!row) return std::nullopt;
  const Eigen::Map<const RowMajor3x3> M(row->numbers.data());
  return requireRotation(M, row->where);
}

}  // namespace urban_nav_core
