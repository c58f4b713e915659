// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "scene_labeler/classes.hpp"
#include "scene_labeler/scene.hpp"

namespace scene_labeler {

/// Evidence of class images of another source on the classes of a model. A given share of an image's pixels is right;
/// where it is wrong, all other classes are equally probable.
class ClassVotes {
 public:
  /// `classes`: of the model. `accuracy`: share of the pixels that are right, between 0 and 1.
  ClassVotes(const std::vector<SceneClass>& classes, double accuracy);

  /// Adds to `logs`, one value per class, the log probabilities of the classes given an image (CV_8U, SceneClass) at a
  /// pixel of it. Returns false, without effect, if the image has no class of the model there.
  bool add(const cv::Mat& image, const Eigen::Vector2f& pixel, float* logs) const;

 private:
  const std::vector<SceneClass> classes_;
  const bool has_one_wall_;
  const float right_, wrong_;  // log probabilities
};

}  // namespace scene_labeler
