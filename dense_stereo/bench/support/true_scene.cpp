// SPDX-License-Identifier: BSD-3-Clause
#include "true_scene.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

namespace dense_stereo::bench {

using urban_nav_core::StereoCamera;

namespace {

constexpr double kCellSize = 0.1, kReach = 5.0;                  // m
constexpr double kObstacle = 0.1, kAnything = 0.05;              // m above the ground
constexpr double kPlanar = 0.03;                                 // m, rms of a plane
constexpr std::size_t kLeastGround = 2000, kLeastObstacle = 60;  // px

std::vector<std::string> listFiles(const std::string& folder, const std::string& ending) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ending) files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

StereoCamera readCamera(const std::string& path, const cv::Size& size) {
  StereoCamera camera;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string key;
    double p[12] = {};
    words >> key;
    for (double& value : p) words >> value;
    if (key == "P0:") camera.left = {p[0], p[5], p[2], p[6], size.width, size.height};
    if (key == "P1:") camera.baseline = -p[3] / p[0];
  }
  return camera;
}

/// True depth and class of one view.
struct TrueView {
  cv::Mat depth, classes;
  cv::Mat right_depth;
  StereoCamera camera;

  std::optional<Eigen::Vector3d> pointAt(int u, int v) const {
    const auto z = static_cast<double>(depth.at<float>(v, u));
    if (!std::isfinite(z) || z > kReach) return std::nullopt;
    return Eigen::Vector3d((u - camera.left.cx) / camera.left.fx * z, (v - camera.left.cy) / camera.left.fy * z, z);
  }
  bool isGround(int u, int v) const {
    const int kind = classes.at<std::uint8_t>(v, u);
    return kind >= 1 && kind <= 3;  // grass, paved, dirt path
  }
  bool isSeenByBoth(int u, int v) const {
    const auto z = depth.at<float>(v, u);
    const double d = camera.left.fx * camera.baseline / static_cast<double>(z);
    const int column = static_cast<int>(std::lround(u - d));
    return column >= 0 && column < depth.cols && std::abs(right_depth.at<float>(v, column) - z) < 0.1F * z;
  }
};

std::optional<TrueScene::Plane> fitGround(const TrueView& view) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
  std::size_t count = 0;
  for (int v = 0; v < view.depth.rows; ++v)
    for (int u = 0; u < view.depth.cols; ++u) {
      if (!view.isGround(u, v)) continue;
      const auto p = view.pointAt(u, v);
      if (!p || p->norm() > kReach) continue;
      mean += *p;
      moment += *p * p->transpose();
      ++count;
    }
  if (count < kLeastGround) return std::nullopt;
  mean /= static_cast<double>(count);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(moment / static_cast<double>(count) -
                                                            mean * mean.transpose());
  if (axes.eigenvalues()(0) > kPlanar * kPlanar) return std::nullopt;
  Eigen::Vector3d up = axes.eigenvectors().col(0);
  if (up.y() > 0.0) up = -up;
  return TrueScene::Plane{up, -up.dot(mean)};
}

/// Returns the number of the connected group of each cell.
std::map<GroundCell, int> connect(const std::set<GroundCell>& cells) {
  std::map<GroundCell, int> group;
  int groups = 0;
  for (const GroundCell& seed : cells) {
    if (group.count(seed) > 0) continue;
    std::vector<GroundCell> open = {seed};
    group[seed] = groups;
    while (!open.empty()) {
      const GroundCell cell = open.back();
      open.pop_back();
      for (int dx = -1; dx <= 1; ++dx)
        for (int dy = -1; dy <= 1; ++dy) {
          const GroundCell next{cell.first + dx, cell.second + dy};
          if (cells.count(next) == 0 || !group.emplace(next, groups).second) continue;
          open.push_back(next);
        }
    }
    ++groups;
  }
  return group;
}

void findTrueObstacles(const TrueView& view, TrueScene& scene) {
  std::map<GroundCell, std::vector<Eigen::Vector3d>> standing;
  for (int v = 0; v < view.depth.rows; ++v)
    for (int u = 0; u < view.depth.cols; ++u) {
      const auto p = view.pointAt(u, v);
      if (!p) continue;
      const double height = scene.ground->above(*p);
      const GroundCell cell = scene.cellAt(*p);
      if (std::abs(height) > kAnything)
        for (int dx = -2; dx <= 2; ++dx)
          for (int dy = -2; dy <= 2; ++dy) scene.occupied.insert({cell.first + dx, cell.second + dy});
      if (height >= kObstacle && height < 2.0 && p->z() >= 1.0 && p->norm() <= kReach && view.isSeenByBoth(u, v))
        standing[cell].push_back(*p);
    }
  std::set<GroundCell> cells;
  for (const auto& [cell, points] : standing) cells.insert(cell);
  std::map<int, TrueObstacle> groups;
  for (const auto& [cell, group] : connect(cells)) {
    auto& points = groups[group].points;
    points.insert(points.end(), standing[cell].begin(), standing[cell].end());
  }
  for (auto& [group, each] : groups)
    if (each.points.size() >= kLeastObstacle) scene.obstacles.push_back(std::move(each));
}

}  // namespace

bool TrueObstacle::isHitBy(const std::vector<ObstaclePoint>& found) const {
  int hits = 0;
  for (const ObstaclePoint& each : found) {
    const Eigen::Vector3d p = each.p_cam.cast<double>();
    const bool near =
        std::any_of(points.begin(), points.end(), [&](const auto& q) { return (p - q).squaredNorm() < 0.04; });
    if (near && ++hits >= 10) return true;
  }
  return false;
}

GroundCell TrueScene::cellAt(const Eigen::Vector3d& p) const {
  const Eigen::Vector3d forward = (Eigen::Vector3d::UnitZ() - ground->up.z() * ground->up).normalized();
  const Eigen::Vector3d right = forward.cross(ground->up);
  return {static_cast<int>(std::floor(forward.dot(p) / kCellSize)),
          static_cast<int>(std::floor(right.dot(p) / kCellSize))};
}

int TrueScene::countFalse(const std::vector<ObstaclePoint>& found) const {
  std::set<GroundCell> cells;
  for (const ObstaclePoint& each : found) cells.insert(cellAt(each.p_cam.cast<double>()));
  std::map<int, bool> explained;
  for (const auto& [cell, group] : connect(cells)) explained[group] = explained[group] || occupied.count(cell) > 0;
  return static_cast<int>(
      std::count_if(explained.begin(), explained.end(), [](const auto& each) { return !each.second; }));
}

void forEachTrueScene(const std::string& folder, const std::string& truth_folder, int step,
                      const std::function<void(const TrueScene&, const NearScene&)>& visit) {
  const auto left = listFiles(folder + "/image_0", ".png"), right = listFiles(folder + "/image_1", ".png");
  const std::string left_truth = truth_folder + "/stereo_left_optical_frame";
  const auto depth = listFiles(left_truth, ".pfm"), classes = listFiles(left_truth, ".png");
  const auto right_depth = listFiles(truth_folder + "/stereo_right_optical_frame", ".pfm");
  std::unique_ptr<NearSceneEstimator> estimator;
  for (std::size_t i = 0; i < left.size(); i += static_cast<std::size_t>(step)) {
    const cv::Mat l = cv::imread(left[i], cv::IMREAD_GRAYSCALE), r = cv::imread(right.at(i), cv::IMREAD_GRAYSCALE);
    const TrueView view{cv::imread(depth.at(i), cv::IMREAD_UNCHANGED), cv::imread(classes.at(i), cv::IMREAD_UNCHANGED),
                        cv::imread(right_depth.at(i), cv::IMREAD_UNCHANGED),
                        readCamera(folder + "/calib.txt", l.size())};
    if (!estimator) estimator = std::make_unique<NearSceneEstimator>(Parameters(), view.camera);
    TrueScene scene;
    scene.ground = fitGround(view);
    if (scene.ground) findTrueObstacles(view, scene);
    visit(scene, estimator->process({0, {l.data, l.cols, l.rows, l.cols}, {r.data, r.cols, r.rows, r.cols}}));
  }
}

}  // namespace dense_stereo::bench
