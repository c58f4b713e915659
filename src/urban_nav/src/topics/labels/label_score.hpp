// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "base/json.hpp"
#include "scene_labeler/labelling/labeler.hpp"

namespace urban_nav {

/// Comparison of labels with the truth, over the returns with a truth; a return without a label is wrong.
class LabelScore {
 public:
  /// `one_wall`: whether the kinds of wall count as one class.
  explicit LabelScore(bool one_wall) : one_wall_(one_wall) {}

  /// Adds a scene; `truth` has one class per return, None where there is no truth.
  void add(const scene_labeler::SceneLabels& labels, const std::vector<scene_labeler::SceneClass>& truth);

  std::size_t points() const { return points_; }
  double accuracy() const;
  double meanF1() const;  ///< over the classes with a truth
  /// Returns the mean difference between stated probability and share of correct labels, over ten bins weighted by
  /// their returns.
  double calibrationError() const;
  /// Sets `points`, `accuracy`, `f1_mean`, `classes`, `confusion`, `sure_confusion`, `reliability`,
  /// `calibration_error`.
  void addTo(Json& json) const;
  /// Returns a table as text.
  std::string print() const;

 private:
  static constexpr std::size_t kNoneIndex = scene_labeler::kClassCount;
  struct Bin {
    std::size_t points = 0, right = 0;
    double stated = 0.0;
  };
  struct Pair {
    double precision = 0.0, recall = 0.0, f1 = 0.0;
  };
  std::size_t truthCount(std::size_t of_class) const;
  Pair pairAt(std::size_t of_class) const;

  bool one_wall_;
  std::size_t points_ = 0;
  /// Number of labels by truth and label; kNoneIndex: no label.
  using Confusion = std::array<std::array<std::size_t, scene_labeler::kClassCount + 1>, scene_labeler::kClassCount>;
  static Json toJson(const Confusion& confusion);
  Confusion confusion_{}, sure_confusion_{};  // of all labels, and of those that are not unsure
  std::array<std::size_t, scene_labeler::kClassCount> patches_{};
  std::array<Bin, 10> bins_{};
};

}  // namespace urban_nav
