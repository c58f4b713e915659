// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/labelling/map_labeler.hpp"

#include <algorithm>
#include <cmath>

#include "labelling/spread.hpp"

namespace scene_labeler {
namespace {

constexpr float square_edge = 10.0F;  // m
constexpr float fused_sure = 0.5F;
constexpr float least_fused = 1e-6F;

}  // namespace

MapLabeler::MapLabeler(const LabelModel& model, int superpixel, double reach, std::vector<Eigen::Vector3f> points,
                       std::vector<std::uint8_t> reflectance)
    : model_(model),
      superpixel_(superpixel),
      reach_(reach),
      points_(std::move(points)),
      reflectance_(std::move(reflectance)),
      logs_(points_.size() * model.classes.size(), 0.0F),
      views_(points_.size(), 0),
      unsure_(points_.size(), 0) {
  for (std::uint32_t i = 0; i < points_.size(); ++i)
    if (points_[i].allFinite()) squares_[squareAt(points_[i])].push_back(i);
}

MapLabeler::Square MapLabeler::squareAt(const Eigen::Vector3f& point) const {
  return {static_cast<int>(std::floor(point.x() / square_edge)), static_cast<int>(std::floor(point.y() / square_edge))};
}

std::vector<std::uint32_t> MapLabeler::pointsAround(const Square& middle, int margin) const {
  std::vector<std::uint32_t> members;
  for (int y = middle.second - margin; y <= middle.second + margin; ++y)
    for (int x = middle.first - margin; x <= middle.first + margin; ++x)
      if (const auto square = squares_.find({x, y}); square != squares_.end())
        members.insert(members.end(), square->second.begin(), square->second.end());
  return members;
}

Scene MapLabeler::makeScene(const std::vector<std::uint32_t>& members) const {
  Scene scene;
  scene.device = lms291_device;
  for (const std::uint32_t i : members) {
    scene.points.push_back(points_[i]);
    scene.reflectance.push_back(static_cast<float>(reflectance_[i]));
  }
  return scene;
}

void MapLabeler::vote(const std::vector<std::uint32_t>& members, const SceneLabels& labels) {
  const std::size_t classes = model_.classes.size();
  for (std::size_t i = 0; i < members.size(); ++i) {
    if (labels.labels[i] == SceneClass::None) continue;
    const std::uint32_t point = members[i];
    ++views_[point];
    if (labels.unsure[i] != 0) ++unsure_[point];
    for (std::size_t k = 0; k < classes; ++k)
      logs_[point * classes + k] += std::log(std::max(labels.probabilities[i * classes + k], least_fused));
  }
}

void MapLabeler::spreadInSquare(const std::vector<std::uint32_t>& members, const std::vector<std::uint16_t>& shown,
                                const std::vector<std::uint8_t>& is_asked) {
  const std::size_t classes = model_.classes.size();
  std::vector<Eigen::Vector3f> points;
  std::vector<std::uint8_t> is_shown;
  std::vector<float> logs;
  for (const std::uint32_t i : members) {
    points.push_back(points_[i]);
    is_shown.push_back(shown[i] != 0 ? 1 : 0);
    const float share = 1.0F / static_cast<float>(std::max<std::uint16_t>(views_[i], 1));
    for (std::size_t k = 0; k < classes; ++k) logs.push_back(share * logs_[i * classes + k]);
  }
  spreadToHidden(points, is_shown, is_asked, classes, logs);
  for (std::size_t i = 0; i < members.size(); ++i)
    if (is_asked[i] != 0)
      std::copy_n(logs.begin() + static_cast<std::ptrdiff_t>(i * classes), classes,
                  logs_.begin() + static_cast<std::ptrdiff_t>(members[i] * classes));
}

std::size_t MapLabeler::add(const SideView& view) {
  const Eigen::Vector3f place = view.T_world_camera.t().cast<float>();
  std::vector<std::uint32_t> members =
      pointsAround(squareAt(place), static_cast<int>(std::ceil(reach_ / static_cast<double>(square_edge))));
  const auto is_far = [&](std::uint32_t i) {
    return (points_[i] - place).head<2>().norm() > static_cast<float>(reach_);
  };
  members.erase(std::remove_if(members.begin(), members.end(), is_far), members.end());
  if (members.empty() || view.image.empty() || !isUsable(view.image)) return 0;
  Scene scene = makeScene(members);
  projectView(view, Eigen::Vector3f::Zero(), scene);
  scene.is_asked = visibleReturns(scene.view);
  vote(members, labelScene(model_, scene, superpixel_));
  return static_cast<std::size_t>(std::count(scene.is_asked.begin(), scene.is_asked.end(), 1));
}

std::vector<PointLabel> MapLabeler::finish() {
  const std::vector<std::uint16_t> shown = views_;
  for (const auto& [square, own] : squares_) {
    if (std::all_of(own.begin(), own.end(), [&](std::uint32_t i) { return shown[i] != 0; })) continue;
    const std::vector<std::uint32_t> members = pointsAround(square, 1);
    Scene scene = makeScene(members);
    for (const std::uint32_t i : members)
      scene.is_asked.push_back(shown[i] == 0 && squareAt(points_[i]) == square ? 1 : 0);
    vote(members, labelScene(model_, scene, superpixel_));
    spreadInSquare(members, shown, scene.is_asked);
  }
  const std::size_t classes = model_.classes.size();
  std::vector<PointLabel> labels(points_.size());
  std::vector<float> p(classes);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (views_[i] == 0) continue;
    for (std::size_t k = 0; k < classes; ++k) p[k] = logs_[i * classes + k] / static_cast<float>(views_[i]);
    normaliseLogs(p.data(), classes);
    const auto best = static_cast<std::size_t>(std::max_element(p.begin(), p.end()) - p.begin());
    const float probability = std::exp(p[best]);
    labels[i] = {model_.classes[best], static_cast<std::uint8_t>(std::lround(255.0F * probability)),
                 probability < fused_sure || 2 * unsure_[i] > views_[i]};
  }
  return labels;
}

}  // namespace scene_labeler
