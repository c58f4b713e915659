// SPDX-License-Identifier: BSD-3-Clause
// Template drift over the surface as the view changes. The front end follows the true path through rendered rooms:
// errors of its measurements by view change since the first observation of the landmark (Frobenius norm of the warp
// minus the identity); and growth of their variance relative to a negligible change, for a change of one, in units of
// the initial variance of the template.
//   swf_vo-bench-creep [--seeds N] [-o results/creep.json]
#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>

#include "front_end/front_end.hpp"
#include "support/program.hpp"
#include "support/run.hpp"
#include "urban_nav_core/testing/bench_table.hpp"
#include "urban_nav_core/testing/quantile.hpp"
#include "urban_nav_core/testing/textured_room.hpp"

namespace {

using namespace swf_vo;
using namespace swf_vo::bench;
using urban_nav_core::ImageView;
using urban_nav_core::Pose;
using urban_nav_core::Vector3d;
using urban_nav_core::testing::BenchTable;
using urban_nav_core::testing::cell;
using urban_nav_core::testing::quantile;
using urban_nav_core::testing::Scene;

constexpr std::array<double, 6> kLimits = {0.05, 0.1, 0.2, 0.4, 0.8, 10.0};
constexpr double kRoughPx = 0.026;  // deviation of the surface from a plane, added to the initial noise

/// Errors of mean u, v and disparity (px), with the initial variance of the template (px^2).
struct Error {
  double change, birth;
  Vector3d px;
};

/// A landmark with its true position.
struct Point {
  Vector3d p, a, b;  ///< in frame 0; two tangents of its surface
  Eigen::Matrix2d born_as;
  double birth;
};

Eigen::Matrix2d toView(const Sequence& sequence, const Pose& T, const Point& point) {
  constexpr double kStep = 1e-4;
  const auto pixel = [&](const Vector3d& p) {
    return sequence.camera.left.project(T.inverse() * p).value_or(Eigen::Vector2d::Zero());
  };
  Eigen::Matrix2d view;
  view.col(0) = (pixel(point.p + kStep * point.a) - pixel(point.p)) / kStep;
  view.col(1) = (pixel(point.p + kStep * point.b) - pixel(point.p)) / kStep;
  return view;
}

/// Converts (u_left, v, u_right) to mean u, v and disparity.
Eigen::Matrix3d combination() {
  Eigen::Matrix3d C;
  C << 0.5, 0.0, 0.5, 0.0, 1.0, 0.0, 1.0, 0.0, -1.0;
  return C;
}

void follow(const RenderedOptions& options, std::vector<Error>& errors) {
  const Sequence sequence = rendered(options);
  const Scene scene = urban_nav_core::testing::texturedRoom({}, options.seed);
  const Pose T_world_first = urban_nav_core::testing::namedMotion(options.motion, "room", options.seed)(0.0);
  FrontEnd front_end(parametersFrom({"swf_vo.pixel_noise_floor=0.001"}), sequence.camera);
  std::map<LandmarkId, Point> points;
  std::map<LandmarkId, MapPoint> map;
  cv::Mat left, right;
  for (std::size_t i = 0; i < sequence.stamps.size(); ++i) {
    sequence.read(i, left, right);
    const auto view = [](const cv::Mat& image) {
      return ImageView{image.data, image.cols, image.rows, static_cast<std::ptrdiff_t>(image.step)};
    };
    std::vector<MapPoint> known;
    known.reserve(map.size());
    for (const auto& [id, point] : map) known.push_back(point);
    const Pose& T = sequence.truth[i];
    const FrontEndResult& result =
        front_end.process(static_cast<FrameId>(i), {sequence.stamps[i], view(left), view(right)},
                          sequence.truth[i > 0 ? i - 1 : 0], T, known, 0.0);
    for (const Observation& seen : result.tracked) {
      const Point& point = points.at(seen.landmark);
      const auto truth = sequence.camera.project(T.inverse() * point.p);
      if (!truth || !(seen.information(0, 0) > 0.0) || !(seen.information(2, 2) > 0.0)) continue;
      const Eigen::Matrix2d warp = toView(sequence, T, point) * point.born_as.inverse();
      errors.push_back({(warp - Eigen::Matrix2d::Identity()).norm(), point.birth, combination() * (seen.z - *truth)});
    }
    for (const Observation& seen : result.fresh) {
      const Pose T_world_camera = T_world_first * T;
      const Vector3d ray = T_world_camera.q() * sequence.camera.left.ray({seen.z[0], seen.z[1]});
      const auto hit = scene.trace(T_world_camera.t(), ray);
      if (!hit) continue;
      const auto& wall = scene.rectangles[hit->rectangle];
      Point point;
      point.p = T_world_first.inverse() * Vector3d(T_world_camera.t() + hit->distance * ray);
      point.a = T_world_first.q().inverse() * wall.a;
      point.b = T_world_first.q().inverse() * wall.b;
      point.born_as = toView(sequence, T, point);
      point.birth = seen.information.inverse()(0, 0) + kRoughPx * kRoughPx;
      points[seen.landmark] = point;
      map[seen.landmark] = {seen.landmark, point.p.homogeneous()};
    }
    for (const LandmarkId id : result.ended) map.erase(id);
    for (const LandmarkId id : result.refuted) map.erase(id);
  }
}

/// Variance without outliers beyond four standard deviations (by the median), which are points on edges.
double variance(const std::vector<double>& values) {
  std::vector<double> sizes;
  sizes.reserve(values.size());
  for (const double value : values) sizes.push_back(std::abs(value));
  const double limit = 4.0 * 1.4826 * quantile(sizes, 0.5);
  double sum = 0.0;
  int count = 0;
  for (const double value : values)
    if (std::abs(value) <= limit) sum += value * value, ++count;
  return count == 0 ? 0.0 : sum / count;
}

/// Observations with similar view change.
struct Bin {
  double change = 0.0, birth = 0.0;
  int count = 0;
  std::array<double, 3> variance{};
};

Bin bin(const std::vector<Error>& errors, double low, double high) {
  Bin result;
  std::array<std::vector<double>, 3> px;
  for (const Error& error : errors) {
    if (error.change < low || error.change >= high) continue;
    for (std::size_t k = 0; k < 3; ++k) px[k].push_back(error.px[static_cast<Eigen::Index>(k)]);
    result.change += error.change;
    result.birth += error.birth;
    ++result.count;
  }
  result.change /= std::max(1, result.count);
  result.birth /= std::max(1, result.count);
  for (std::size_t k = 0; k < 3; ++k) result.variance[k] = variance(px[k]);
  return result;
}

void addRows(BenchTable& table, double noise, const std::vector<Error>& errors) {
  const Bin first = bin(errors, 0.0, kLimits[0]);
  for (std::size_t i = 0; i < kLimits.size(); ++i) {
    const Bin here = bin(errors, i == 0 ? 0.0 : kLimits[i - 1], kLimits[i]);
    if (here.count < 1000) continue;
    std::vector<std::string> row = {cell(noise, 0), cell(here.change, 2), std::to_string(here.count),
                                    cell(std::sqrt(here.birth), 3)};
    for (const double value : here.variance) row.push_back(cell(std::sqrt(value), 3));
    for (std::size_t k = 0; k < 3; ++k)
      row.push_back(
          i < 2 ? "" : cell((here.variance[k] - first.variance[k]) / ((here.change - first.change) * here.birth), 2));
    table.add(row);
  }
}

}  // namespace

int main(int argc, char** argv) try {
  int seeds = 3;
  std::string output;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string word = argv[i];
    if (word == "--seeds") seeds = std::stoi(argv[i + 1]);
    else if (word == "-o") output = argv[i + 1];
  }
  BenchTable table({"image noise (grey levels)", "change of the view", "observations", "born with, px", "u, px",
                    "v, px", "disparity, px", "growth of the variance: u", "v", "disparity"},
                   argc, argv);
  for (const double noise : {1.0, 3.0, 6.0}) {
    std::vector<Error> errors;
    for (const char* motion : {"wander", "turns", "loop"})
      for (int seed = 1; seed <= seeds; ++seed) {
        RenderedOptions options;
        options.motion = motion;
        options.seed = static_cast<std::uint32_t>(seed);
        options.noise = noise;
        follow(options, errors);
      }
    addRows(table, noise, errors);
  }
  return show(table, output);
} catch (const std::exception& error) {
  return complain(error);
}
