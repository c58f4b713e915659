// SPDX-License-Identifier: BSD-3-Clause
// A vehicle stated to be at rest (euroc_still): distance and rotation by the filter, and rotation by its gyroscope.
//   swf_vo-bench-still [--set swf_vo.NAME=VALUE]... [-o results/still.json]
#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>

#include "support/program.hpp"
#include "support/run.hpp"
#include "urban_nav_core/camera/rectify.hpp"
#include "urban_nav_core/io/calibration.hpp"
#include "urban_nav_core/io/csv.hpp"
#include "urban_nav_core/testing/bench_table.hpp"

namespace {

using namespace swf_vo::bench;
using urban_nav_core::CsvTable;
using urban_nav_core::Pose;
using urban_nav_core::RectifyMap;
using urban_nav_core::StampNs;
using urban_nav_core::testing::BenchTable;
using urban_nav_core::testing::cell;

constexpr double kDeg = M_PI / 180.0;
constexpr StampNs kCalmAfter = 1'750'000'000;  // ns: from then on the vehicle is at rest, and the rates are the bias

struct Eye {
  CsvTable files;
  std::string folder;
  RectifyMap map;

  cv::Mat read(std::size_t frame) const {
    const cv::Mat raw = cv::imread(folder + "/data/" + files.text(frame, 1), cv::IMREAD_GRAYSCALE);
    std::vector<std::uint8_t> pixels;
    const auto view = map.remap({raw.data, raw.cols, raw.rows, static_cast<std::ptrdiff_t>(raw.step)}, pixels);
    return cv::Mat(view.height, view.width, CV_8UC1, pixels.data(), static_cast<std::size_t>(view.stride)).clone();
  }
};

Sequence eurocFolder(const std::string& mav0) {
  const std::string left = mav0 + "/cam0", right = mav0 + "/cam1";
  const auto first = urban_nav_core::readEurocCamera(left + "/sensor.yaml"),
             second = urban_nav_core::readEurocCamera(right + "/sensor.yaml");
  const auto left_raw = urban_nav_core::rawCamera(first.info, left),
             right_raw = urban_nav_core::rawCamera(second.info, right);
  const auto pair =
      urban_nav_core::rectifyStereo(left_raw, right_raw, second.T_body_camera.inverse() * first.T_body_camera, mav0);
  const Eye left_eye{CsvTable::read(left + "/data.csv"), left, RectifyMap(left_raw, pair.R_left, pair.camera.left)};
  const Eye right_eye{CsvTable::read(right + "/data.csv"), right,
                      RectifyMap(right_raw, pair.R_right, pair.camera.left)};
  Sequence sequence;
  sequence.camera = pair.camera;
  for (std::size_t row = 0; row < left_eye.files.rows(); ++row)
    sequence.stamps.push_back(left_eye.files.integer(row, 0));
  sequence.truth.resize(sequence.stamps.size());
  sequence.read = [left_eye, right_eye](std::size_t frame, cv::Mat& l, cv::Mat& r) {
    l = left_eye.read(frame);
    r = right_eye.read(frame);
  };
  return sequence;
}

/// Returns the rotation of the gyroscope from the first of the stamps to each of them; its bias is the rate at rest.
std::vector<double> turned(const std::string& imu, const std::vector<StampNs>& stamps) {
  const CsvTable table = CsvTable::read(imu);
  const auto rate = [&](std::size_t row) {
    return Eigen::Vector3d(table.number(row, 1), table.number(row, 2), table.number(row, 3));
  };
  Eigen::Vector3d bias = Eigen::Vector3d::Zero(), angle = Eigen::Vector3d::Zero();
  int count = 0;
  for (std::size_t row = 0; row < table.rows(); ++row)
    if (table.integer(row, 0) > stamps.front() + kCalmAfter) bias += rate(row), ++count;
  bias /= std::max(1, count);
  std::vector<double> angles;
  std::size_t row = 0;
  while (row + 1 < table.rows() && table.integer(row, 0) < stamps.front()) ++row;
  for (const StampNs stamp : stamps) {
    for (; row + 1 < table.rows() && table.integer(row, 0) < stamp; ++row)
      angle += 1e-9 * static_cast<double>(table.integer(row + 1, 0) - table.integer(row, 0)) * (rate(row) - bias);
    angles.push_back(angle.norm() / kDeg);
  }
  return angles;
}

void add(BenchTable& table, const char* label, const std::vector<Pose>& poses, const std::vector<double>& gyroscope) {
  double most = 0.0, apart = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const double angle = angleBetween(poses.front(), poses[i]) / kDeg;
    most = std::max(most, angle);
    apart = std::max(apart, std::abs(angle - gyroscope[i]));
    squares += std::pow(distanceBetween(poses.front(), poses[i]), 2);
  }
  table.add({label, cell(1000.0 * std::sqrt(squares / static_cast<double>(poses.size())), 2), cell(most, 3),
             cell(angleBetween(poses.front(), poses.back()) / kDeg, 3), cell(apart, 3)});
}

}  // namespace

int main(int argc, char** argv) try {
  std::vector<std::string> sets;
  std::string output;
  for (int i = 1; i + 1 < argc; i += 2) (std::string(argv[i]) == "-o" ? output : sets.emplace_back()) = argv[i + 1];
  const std::string folder = dataFolder("euroc_still");
  if (folder.empty()) return 1;
  const Sequence sequence = eurocFolder(folder + "/mav0");
  const Run result = run(sequence, parametersFrom(sets));
  const std::vector<double> gyroscope = turned(folder + "/mav0/imu0/data.csv", sequence.stamps);
  BenchTable table({"euroc_still", "position, rms, mm", "turned, at most, deg", "turned, at the end, deg",
                    "apart from the gyroscope, at most, deg"},
                   argc, argv);
  add(table, "swf_vo, now", result.now, gyroscope);
  add(table, "swf_vo, settled", result.settled, gyroscope);
  table.add({"gyroscope, bias taken off", "", cell(*std::max_element(gyroscope.begin(), gyroscope.end()), 3),
             cell(gyroscope.back(), 3), ""});
  return show(table, output);
} catch (const std::exception& error) {
  return complain(error);
}
