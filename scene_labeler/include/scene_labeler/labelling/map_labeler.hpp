// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "scene_labeler/drive/drive_scene.hpp"
#include "scene_labeler/labelling/labeler.hpp"

namespace scene_labeler {

/// Label of a point of a map. The probability has steps of 1/255.
struct PointLabel {
  SceneClass label = SceneClass::None;
  std::uint8_t probability = 0;  ///< times 255
  bool is_unsure = true;
};

/// Labels the points of a map, each from all images that show it, the others by shape and by what the images say of
/// their surroundings. The result depends on the order of the views only by rounding, and not on the number of threads.
/// Not thread-safe.
class MapLabeler {
 public:
  /// `points`: m, some 5 cm apart. `reflectance`: one per point, as the robot's lasers measure it. The model must
  /// outlive the labeler. `superpixel`: px. `reach`: m, of a view.
  MapLabeler(const LabelModel& model, int superpixel, double reach, std::vector<Eigen::Vector3f> points,
             std::vector<std::uint8_t> reflectance);

  /// Labels what an image shows. Returns the number of these points.
  std::size_t add(const SideView& view);
  /// Labels the points that no image has shown, and returns the labels of all points.
  std::vector<PointLabel> finish();

 private:
  using Square = std::pair<int, int>;
  Square squareAt(const Eigen::Vector3f& point) const;
  /// Appends the points of the squares within `reach` of a place, up to `margin` squares around `middle`.
  std::vector<std::uint32_t> pointsAround(const Square& middle, int margin) const;
  Scene makeScene(const std::vector<std::uint32_t>& members) const;
  /// Uses the labels that images gave for the points of a square that no image shows.
  void spreadInSquare(const std::vector<std::uint32_t>& members, const std::vector<std::uint16_t>& shown,
                      const std::vector<std::uint8_t>& is_asked);
  void vote(const std::vector<std::uint32_t>& members, const SceneLabels& labels);

  const LabelModel& model_;
  const int superpixel_;
  const double reach_;
  const std::vector<Eigen::Vector3f> points_;
  const std::vector<std::uint8_t> reflectance_;
  std::map<Square, std::vector<std::uint32_t>> squares_;  // points of squares of the ground
  std::vector<float> logs_;                               // of each point one for each class, summed over views
  std::vector<std::uint16_t> views_, unsure_;
};

}  // namespace scene_labeler
