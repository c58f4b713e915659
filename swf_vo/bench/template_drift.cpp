// SPDX-License-Identifier: BSD-3-Clause
// Template drift on non-planar surfaces. The front end follows the true path through sequences with exact images:
// distance of each landmark's measurement from its best position for the true poses, now and some frames later,
// compared with the process noise (Observation::template_drift_covariance). Means of five frames, corrected for their
// scatter; without the largest hundredth.
//   swf_vo-bench-template_drift FOLDER... [-o results/template_drift.json]
// FOLDER: a sequence in KITTI's layout with poses.txt; pooled over names that differ in up to three last digits.
#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "front_end/front_end.hpp"
#include "support/program.hpp"
#include "support/run.hpp"
#include "urban_nav_core/testing/bench_table.hpp"
#include "urban_nav_core/testing/quantile.hpp"

namespace {

using namespace swf_vo;
using namespace swf_vo::bench;
using Eigen::Matrix2d;
using Eigen::Matrix3d;
using urban_nav_core::ImageView;
using urban_nav_core::Pose;
using urban_nav_core::StereoCamera;
using urban_nav_core::Vector3d;
using urban_nav_core::testing::BenchTable;
using urban_nav_core::testing::cell;
using urban_nav_core::testing::quantile;

constexpr std::array<std::size_t, 4> kGaps = {10, 25, 50, 100};
constexpr std::size_t kHalf = 2;      // frames on each side of a mean
constexpr double kFarthest = 1000.0;  // m: beyond, motion is too small to determine the position of a landmark
constexpr int kFittingSteps = 6;
constexpr double kUsualResidual = 3.0;  // standard deviations; Huber

/// A measurement of a landmark at a true pose.
struct PatchObservation {
  std::size_t frame = 0;
  Pose T_camera_odom;
  Vector3d z, sigma;        ///< u_left, v and disparity, px
  double sigma_px;          ///< standard deviation of the alignment only
  double drift_u, drift_v;  ///< process noise since the first observation, px^2
};

/// (x/z, y/z, 1/z) in the camera of the first observation, and the measurements of a landmark.
struct Life {
  Pose T_odom_birth;
  Vector3d place;
  Matrix3d covariance;
  std::vector<PatchObservation> seen;
};

/// u_left, v and disparity of a landmark; homogeneous, so that far ones need no special case.
Vector3d predict(const StereoCamera& camera, const Pose& T_odom_birth, const Vector3d& place,
                 const Pose& T_camera_odom) {
  const Vector3d p_odom = T_odom_birth.q() * Vector3d(place.x(), place.y(), 1.0) + place.z() * T_odom_birth.t();
  const Vector3d p = T_camera_odom.q() * p_odom + place.z() * T_camera_odom.t();
  return {camera.left.fx * p.x() / p.z() + camera.left.cx, camera.left.fy * p.y() / p.z() + camera.left.cy,
          camera.left.fx * camera.baseline * place.z() / p.z()};
}

Matrix3d jacobian(const StereoCamera& camera, const Life& life, const Pose& T_camera_odom) {
  Matrix3d J;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const Vector3d step = 1e-6 * Vector3d::Unit(k);
    J.col(k) = (predict(camera, life.T_odom_birth, life.place + step, T_camera_odom) -
                predict(camera, life.T_odom_birth, life.place - step, T_camera_odom)) /
               2e-6;
  }
  return J;
}

Vector3d withDisparity(const Vector3d& z) { return {z[0], z[1], z[0] - z[2]}; }

/// Tracks the landmarks of a sequence with the true poses, which the front end receives.
class Follower {
 public:
  explicit Follower(Sequence sequence)
      : sequence_(std::move(sequence)), front_end_(parametersFrom({}), sequence_.camera) {}

  std::vector<Life> run() {
    cv::Mat left, right;
    const auto view = [](const cv::Mat& image) {
      return ImageView{image.data, image.cols, image.rows, static_cast<std::ptrdiff_t>(image.step)};
    };
    for (std::size_t i = 0; i < sequence_.stamps.size(); ++i) {
      sequence_.read(i, left, right);
      const FrontEndResult& result =
          front_end_.process(static_cast<FrameId>(i), {sequence_.stamps[i], view(left), view(right)},
                             sequence_.truth[i > 0 ? i - 1 : 0], sequence_.truth[i], map(), 0.0);
      const Pose T_camera_odom = sequence_.truth[i].inverse();
      for (const Observation& seen : result.tracked) update(seen, i, T_camera_odom);
      for (const Observation& seen : result.fresh) begin(seen, i, T_camera_odom);
      for (const auto* gone : {&result.ended, &result.refuted})
        for (const LandmarkId id : *gone) end(id);
    }
    while (!alive_.empty()) end(alive_.begin()->first);
    return std::move(lives_);
  }

 private:
  std::vector<MapPoint> map() const {
    std::vector<MapPoint> points;
    for (const auto& [id, life] : alive_) {
      const Vector3d p = life.T_odom_birth.q() * Vector3d(life.place.x(), life.place.y(), 1.0) +
                         life.place.z() * life.T_odom_birth.t();
      points.push_back({id, {p.x(), p.y(), p.z(), life.place.z()}});
    }
    return points;
  }

  void begin(const Observation& seen, std::size_t frame, const Pose& T_camera_odom) {
    const auto& camera = sequence_.camera;
    const double per_disparity = 1.0 / (camera.left.fx * camera.baseline);
    const Vector3d z = withDisparity(seen.z);
    Life life;
    life.T_odom_birth = T_camera_odom.inverse();
    life.place << (z[0] - camera.left.cx) / camera.left.fx, (z[1] - camera.left.cy) / camera.left.fy,
        std::max(1e-6, per_disparity * z[2]);
    const Vector3d sigma = sigmas(seen);
    life.covariance = Vector3d(sigma[0] / camera.left.fx, sigma[1] / camera.left.fy, per_disparity * sigma[2])
                          .cwiseAbs2()
                          .asDiagonal();
    life.seen.push_back({frame, T_camera_odom, z, sigma, seen.sigma_px, 0.0, 0.0});
    alive_[seen.landmark] = life;
  }

  static Vector3d sigmas(const Observation& seen) {
    const Matrix3d covariance = seen.information.inverse();
    return {std::sqrt(covariance(0, 0)), std::sqrt(covariance(1, 1)),
            std::sqrt(covariance(0, 0) + covariance(2, 2) - 2.0 * covariance(0, 2))};
  }

  /// Kalman update, so that the front end searches at the right position.
  void update(const Observation& seen, std::size_t frame, const Pose& T_camera_odom) {
    if (!(seen.information(0, 0) > 0.0) || !(seen.information(2, 2) > 0.0)) return;
    Life& life = alive_.at(seen.landmark);
    const auto& camera = sequence_.camera;
    const Vector3d z = withDisparity(seen.z), sigma = sigmas(seen);
    const Matrix2d& drift = seen.template_drift_covariance;
    life.covariance(0, 0) += drift(0, 0) / (camera.left.fx * camera.left.fx);
    life.covariance(1, 1) += drift(1, 1) / (camera.left.fy * camera.left.fy);
    const Matrix3d J = jacobian(camera, life, T_camera_odom);
    Matrix3d S = J * life.covariance * J.transpose();
    S.diagonal() += sigma.cwiseAbs2();
    const Matrix3d gain = life.covariance * J.transpose() * S.inverse();
    life.place += gain * (z - predict(camera, life.T_odom_birth, life.place, T_camera_odom));
    life.place.z() = std::max(life.place.z(), 1e-6);
    life.covariance = ((Matrix3d::Identity() - gain * J) * life.covariance).eval();
    const PatchObservation& last = life.seen.back();
    life.seen.push_back(
        {frame, T_camera_odom, z, sigma, seen.sigma_px, last.drift_u + drift(0, 0), last.drift_v + drift(1, 1)});
  }

  void end(LandmarkId id) {
    const auto at = alive_.find(id);
    if (at == alive_.end()) return;
    if (at->second.seen.size() > kGaps.front() + 4 * kHalf) lives_.push_back(std::move(at->second));
    alive_.erase(at);
  }

  Sequence sequence_;
  FrontEnd front_end_;
  std::map<LandmarkId, Life> alive_;
  std::vector<Life> lives_;
};

/// Returns the distances from the best position (u, v, disparity, px) in each frame; empty without one.
std::vector<Vector3d> residualsAtBestPlace(const StereoCamera& camera, Life& life) {
  for (int step = 0; step < kFittingSteps; ++step) {
    Matrix3d H = Matrix3d::Zero();
    Vector3d b = Vector3d::Zero();
    for (const PatchObservation& seen : life.seen) {
      const Matrix3d J = jacobian(camera, life, seen.T_camera_odom);
      const Vector3d r = seen.z - predict(camera, life.T_odom_birth, life.place, seen.T_camera_odom);
      const double huber = std::min(1.0, kUsualResidual / r.cwiseQuotient(seen.sigma).norm());
      const Matrix3d W = huber * seen.sigma.cwiseAbs2().cwiseInverse().asDiagonal();
      H += J.transpose() * W * J;
      b += J.transpose() * W * r;
    }
    life.place += H.ldlt().solve(b);
  }
  std::vector<Vector3d> residuals;
  if (!life.place.allFinite() || !(life.place.z() > 1.0 / kFarthest)) return residuals;
  for (const PatchObservation& seen : life.seen)
    residuals.push_back(seen.z - predict(camera, life.T_odom_birth, life.place, seen.T_camera_odom));
  return residuals;
}

/// Displacement of a landmark between two means of five frames: squares corrected for the scatter of the means, px^2.
struct Moved {
  Vector3d squared;
  double largest, allowed, sigma;  ///< for u and v; allowed: px^2, sigma: of the alignment, px
};

void add(const std::vector<Vector3d>& residuals, const Life& life, std::size_t gap, std::vector<Moved>& moved) {
  const std::size_t apart = std::max<std::size_t>(5, gap / 5);
  for (std::size_t i = kGaps.front(); i + gap + kHalf < residuals.size(); i += apart) {
    const std::size_t j = i + gap;
    if (10 * (life.seen[j].frame - life.seen[i].frame) > 11 * gap) continue;
    std::array<Vector3d, 2> mean = {Vector3d::Zero(), Vector3d::Zero()};
    Vector3d scatter = Vector3d::Zero();
    constexpr double kCount = 2 * kHalf + 1;
    for (std::size_t side = 0; side < 2; ++side) {
      const std::size_t middle = side == 0 ? i : j;
      for (std::size_t k = middle - kHalf; k <= middle + kHalf; ++k) mean[side] += residuals[k] / kCount;
      for (std::size_t k = middle - kHalf; k <= middle + kHalf; ++k)
        scatter += (residuals[k] - mean[side]).cwiseAbs2() / (kCount * (kCount - 1.0));
    }
    const Vector3d squared = (mean[1] - mean[0]).cwiseAbs2();
    const PatchObservation &from = life.seen[i], &to = life.seen[j];
    moved.push_back({squared - scatter, std::max(squared[0], squared[1]),
                     0.5 * (to.drift_u - from.drift_u + to.drift_v - from.drift_v), to.sigma_px});
  }
}

std::string root(double squared) { return cell(std::sqrt(std::max(0.0, squared)), 3); }

void addRow(const std::string& name, std::size_t landmarks, std::size_t gap, std::vector<Moved> moved,
            BenchTable& table) {
  std::sort(moved.begin(), moved.end(), [](const Moved& a, const Moved& b) { return a.largest < b.largest; });
  moved.resize(moved.size() * 99 / 100);
  if (moved.size() < 100) return;
  std::sort(moved.begin(), moved.end(), [](const Moved& a, const Moved& b) { return a.sigma < b.sigma; });
  const auto mean = [&](std::size_t from, std::size_t to, const auto& of) {
    double sum = 0.0;
    for (std::size_t i = from; i < to; ++i) sum += of(moved[i]);
    return sum / static_cast<double>(to - from);
  };
  const auto both = [](const Moved& m) { return 0.5 * (m.squared[0] + m.squared[1]); };
  const auto allowed = [](const Moved& m) { return m.allowed; };
  const std::size_t n = moved.size();
  std::vector<std::string> row = {name, std::to_string(landmarks), std::to_string(gap)};
  for (Eigen::Index k = 0; k < 3; ++k) row.push_back(root(mean(0, n, [k](const Moved& m) { return m.squared[k]; })));
  row.push_back(root(mean(0, n, allowed)));
  for (std::size_t quarter = 0; quarter < 4; ++quarter) {
    const std::size_t from = quarter * n / 4, to = (quarter + 1) * n / 4;
    row.push_back(cell(mean(from, to, both) / mean(from, to, allowed), 1));
  }
  table.add(row);
}

}  // namespace

int main(int argc, char** argv) try {
  const FoldersAndOutput asked = foldersAndOutput(argc, argv);
  std::map<std::string, std::array<std::vector<Moved>, kGaps.size()>> pools;
  std::map<std::string, std::size_t> landmarks;
  for (const std::string& folder : asked.folders) {
    Sequence sequence = kittiFolder(folder);
    const StereoCamera camera = sequence.camera;
    const std::string name = poolName(sequence.name);
    for (Life& life : Follower(std::move(sequence)).run()) {
      const std::vector<Vector3d> residuals = residualsAtBestPlace(camera, life);
      landmarks[name] += residuals.empty() ? 0 : 1;
      for (std::size_t g = 0; g < kGaps.size(); ++g) add(residuals, life, kGaps[g], pools[name][g]);
    }
  }
  BenchTable table({"sequences", "landmarks", "frames apart", "u, px", "v, px", "disparity, px", "allowed for, px",
                    "squared, over what is allowed for: best quarter", "second", "third", "worst quarter"},
                   argc, argv);
  for (const auto& [name, pool] : pools)
    for (std::size_t g = 0; g < kGaps.size(); ++g) addRow(name, landmarks[name], kGaps[g], pool[g], table);
  table.note(
      "Landmarks observed in at least 19 frames. Displacement between means over five frames, rms; quarters by the "
      "standard deviation of their alignment; 1 is expected.");
  return show(table, asked.output);
} catch (const std::exception& error) {
  return complain(error);
}
