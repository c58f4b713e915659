// SPDX-License-Identifier: BSD-3-Clause
#include "labelling/class_votes.hpp"

#include <algorithm>
#include <cmath>

namespace scene_labeler {
namespace {

bool hasClass(const std::vector<SceneClass>& classes, SceneClass wanted) {
  return std::find(classes.begin(), classes.end(), wanted) != classes.end();
}

}  // namespace

ClassVotes::ClassVotes(const std::vector<SceneClass>& classes, double accuracy)
    : classes_(classes),
      has_one_wall_(hasClass(classes, SceneClass::Wall)),
      right_(static_cast<float>(std::log(accuracy))),
      wrong_(static_cast<float>(std::log((1.0 - accuracy) / static_cast<double>(classes.size() - 1)))) {}

bool ClassVotes::add(const cv::Mat& image, const Eigen::Vector2f& pixel, float* logs) const {
  auto named = static_cast<SceneClass>(
      image.at<std::uint8_t>(static_cast<int>(std::lround(pixel.y())), static_cast<int>(std::lround(pixel.x()))));
  if (has_one_wall_) named = withOneWall(named);
  if (!hasClass(classes_, named)) return false;
  for (std::size_t k = 0; k < classes_.size(); ++k) logs[k] += classes_[k] == named ? right_ : wrong_;
  return true;
}

}  // namespace scene_labeler
