// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/labelling/map_labeler.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "labelling/class_votes.hpp"
#include "labelling/spread.hpp"

namespace scene_labeler {
namespace {

constexpr double kSquareEdge = 10.0;  // m
constexpr float kFusedSure = 0.5F;   // as kSureWhenFused of DriveLabeler
constexpr float kLeastFused = 1e-6F;

int toSquare(double coordinate) { return static_cast<int>(std::floor(coordinate / kSquareEdge)); }

std::vector<PlacedView> inOrder(std::vector<PlacedView> views) {
  std::stable_sort(views.begin(), views.end(), [](const PlacedView& a, const PlacedView& b) {
    return a.T_map_camera.t().y() < b.T_map_camera.t().y();
  });
  return views;
}

}  // namespace

MapLabeler::MapLabeler(const LabelModel& model, const Options& options, std::vector<PlacedView> views,
                       Callbacks callbacks)
    : model_(model),
      options_(options),
      views_(inOrder(std::move(views))),
      callbacks_(std::move(callbacks)),
      frequencies_(model),
      next_row_(std::numeric_limits<int>::min()) {}

void MapLabeler::addPoints(const std::vector<Eigen::Vector3f>& points, const std::vector<float>& reflectance) {
  for (std::size_t i = 0; i < points.size(); ++i, ++next_point_) {
    if (!points[i].allFinite()) {
      callbacks_.take_label(next_point_, {});
      continue;
    }
    SquarePoints& square =
        squares_[{toSquare(static_cast<double>(points[i].y())), toSquare(static_cast<double>(points[i].x()))}];
    square.numbers.push_back(next_point_);
    square.points.push_back(points[i]);
    square.reflectance.push_back(reflectance[i]);
    square.is_shown.push_back(0);
    square.logs.resize(square.logs.size() + model_.classes.size(), 0.0F);
    square.views.push_back(0);
    square.unsure.push_back(0);
    square.in_new_place.push_back(0);
    ++held_;
  }
}

std::vector<MapLabeler::Member> MapLabeler::pointsAround(const Square& middle, int margin) {
  std::vector<Member> members;
  for (int row = middle.first - margin; row <= middle.first + margin; ++row)
    for (int column = middle.second - margin; column <= middle.second + margin; ++column)
      if (const auto square = squares_.find({row, column}); square != squares_.end())
        for (std::size_t i = 0; i < square->second.points.size(); ++i) members.push_back({&square->second, i});
  return members;
}

Scene MapLabeler::makeScene(const std::vector<Member>& members) {
  Scene scene;
  bool is_known = false;
  for (const Member& member : members) {
    scene.points.push_back(member.point());
    scene.reflectance.push_back(member.square->reflectance[member.index]);
    is_known = is_known || !std::isnan(scene.reflectance.back());
  }
  if (is_known) scene.device = kLms291Device;
  else scene.reflectance.clear();
  return scene;
}

void MapLabeler::vote(const std::vector<Member>& members, const SceneLabels& labels, bool by_image) {
  const std::size_t classes = model_.classes.size();
  for (std::size_t i = 0; i < members.size(); ++i) {
    if (labels.labels[i] == SceneClass::None) continue;
    SquarePoints& square = *members[i].square;
    const std::size_t point = members[i].index;
    ++square.views[point];
    if (by_image) square.is_shown[point] = 1;
    if (labels.unsure[i] != 0) ++square.unsure[point];
    if (isNewPlace(labels.share_unlike)) ++square.in_new_place[point];
    for (std::size_t k = 0; k < classes; ++k)
      square.logs[point * classes + k] += std::log(std::max(labels.probabilities[i * classes + k], kLeastFused));
  }
}

void MapLabeler::spreadInSquare(const std::vector<Member>& members, const std::vector<std::uint8_t>& is_asked) {
  const std::size_t classes = model_.classes.size();
  std::vector<Eigen::Vector3f> points;
  std::vector<std::uint8_t> is_shown;
  std::vector<float> logs;
  for (const Member& member : members) {
    const SquarePoints& square = *member.square;
    points.push_back(member.point());
    is_shown.push_back(square.is_shown[member.index]);
    const float share = 1.0F / static_cast<float>(std::max<std::uint16_t>(square.views[member.index], 1));
    for (std::size_t k = 0; k < classes; ++k) logs.push_back(share * square.logs[member.index * classes + k]);
  }
  spreadToHidden(points, is_shown, is_asked, model_.classes, logs);
  for (std::size_t i = 0; i < members.size(); ++i)
    if (is_asked[i] != 0)
      std::copy_n(logs.begin() + static_cast<std::ptrdiff_t>(i * classes), classes,
                  members[i].square->logs.begin() + static_cast<std::ptrdiff_t>(members[i].index * classes));
}

void MapLabeler::labelView(const PlacedView& view) {
  const Eigen::Vector3f place = view.T_map_camera.t().cast<float>();
  std::vector<Member> members = pointsAround({toSquare(view.T_map_camera.t().y()), toSquare(view.T_map_camera.t().x())},
                                             static_cast<int>(std::ceil(options_.reach / kSquareEdge)));
  const auto is_far = [&](const Member& member) {
    return (member.point() - place).head<2>().norm() > static_cast<float>(options_.reach);
  };
  members.erase(std::remove_if(members.begin(), members.end(), is_far), members.end());
  if (members.empty()) return;
  const SideView shown{view.camera, view.T_map_camera, callbacks_.load(view.image)};
  const bool is_sound = shown.image.type() == CV_8UC3 && shown.image.cols == view.camera.pinhole.width &&
                        shown.image.rows == view.camera.pinhole.height;
  if (!is_sound || !isUsable(shown.image)) return callbacks_.take_view(view.image, {});
  Scene scene = makeScene(members);
  projectView(shown, Eigen::Vector3f::Zero(), scene);
  scene.is_asked = scene.view.is_visible;
  const FeatureTable table = measureSceneFeatures(model_, scene);
  MountingCheck& mounting = findMounting(view.device);
  mounting.add(scene, table);
  if (mounting.isUpsideDown()) return callbacks_.take_view(view.image, {0, true, false, false});
  const SceneLabels labels = labelScene(model_, scene, options_.superpixel, table);
  vote(members, labels, true);
  const bool has_classes = voteByClasses(view, scene.view, members);
  const auto labelled = std::count(scene.is_asked.begin(), scene.is_asked.end(), std::uint8_t{1});
  callbacks_.take_view(view.image,
                       {static_cast<std::size_t>(labelled), false, isNewPlace(labels.share_unlike), has_classes});
}

bool MapLabeler::voteByClasses(const PlacedView& view, const SceneView& shown, const std::vector<Member>& members) {
  if (!callbacks_.load_classes) return false;
  const cv::Mat image = callbacks_.load_classes(view.image);
  if (image.empty() || image.size() != shown.image.size()) return false;
  const ClassVotes votes(model_.classes, options_.class_accuracy);
  for (std::size_t i = 0; i < members.size(); ++i) {
    SquarePoints& square = *members[i].square;
    const std::size_t point = members[i].index;
    if (shown.is_visible[i] == 0 || square.views[point] == 0) continue;
    if (votes.add(image, shown.pixels[i], &square.logs[point * model_.classes.size()])) ++square.views[point];
  }
  return true;
}

MountingCheck& MapLabeler::findMounting(std::size_t device) {
  return mountings_.try_emplace(device, model_).first->second;
}

void MapLabeler::labelHidden(const Square& square, const SquarePoints& own) {
  if (std::all_of(own.is_shown.begin(), own.is_shown.end(), [](std::uint8_t shown) { return shown != 0; })) return;
  const std::vector<Member> members = pointsAround(square, 1);
  Scene scene = makeScene(members);
  for (const Member& member : members)
    scene.is_asked.push_back(member.square == &own && own.is_shown[member.index] == 0 ? 1 : 0);
  vote(members, labelScene(model_, scene, options_.superpixel), false);
  spreadInSquare(members, scene.is_asked);
}

void MapLabeler::giveLabels(const SquarePoints& square) {
  const std::size_t classes = model_.classes.size();
  std::vector<float> logs;
  std::vector<std::uint8_t> is_in_new_place;
  for (std::size_t i = 0; i < square.points.size(); ++i) {
    if (square.views[i] == 0) continue;
    is_in_new_place.push_back(2 * square.in_new_place[i] > square.views[i] ? 1 : 0);
    for (std::size_t k = 0; k < classes; ++k)
      logs.push_back(square.logs[i * classes + k] / static_cast<float>(square.views[i]));
  }
  for (std::size_t at = 0; at < logs.size(); at += classes) normaliseLogs(logs.data() + at, classes);
  frequencies_.correct(logs, is_in_new_place);
  const float* p = logs.data();
  for (std::size_t i = 0; i < square.points.size(); ++i) {
    PointLabel label;
    if (square.views[i] > 0) {
      const auto best = static_cast<std::size_t>(std::max_element(p, p + classes) - p);
      const float probability = std::exp(p[best]);
      p += classes;
      label = {model_.classes[best], static_cast<std::uint8_t>(std::lround(255.0F * probability)),
               probability < kFusedSure || 2 * square.unsure[i] > square.views[i]};
    }
    callbacks_.take_label(square.numbers[i], label);
  }
}

void MapLabeler::labelRowsBelow(double y) {
  const auto isComplete = [&](int row) {  // the next row belongs to its surroundings
    return static_cast<double>(row + 2) * kSquareEdge + options_.reach <= y;
  };
  for (auto& [square, own] : squares_) {
    if (square.first < next_row_) continue;
    if (!isComplete(square.first)) break;
    labelHidden(square, own);
    giveLabels(own);
  }
  while (!squares_.empty() && isComplete(squares_.begin()->first.first + 1)) {
    held_ -= squares_.begin()->second.points.size();
    squares_.erase(squares_.begin());
  }
  for (const auto& entry : squares_)
    if (isComplete(entry.first.first)) next_row_ = std::max(next_row_, entry.first.first + 1);
}

void MapLabeler::sweepTo(double y) {
  while (next_view_ < views_.size() && views_[next_view_].T_map_camera.t().y() + options_.reach < y)
    labelView(views_[next_view_++]);
  labelRowsBelow(y - options_.reach);
}

void MapLabeler::finish() { sweepTo(std::numeric_limits<double>::infinity()); }

}  // namespace scene_labeler
