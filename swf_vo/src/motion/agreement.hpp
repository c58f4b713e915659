// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "urban_nav_core/geometry/so3.hpp"
#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_core/types/stamp.hpp"

namespace swf_vo {

/// One step as images and as a sensor have it: rotation vectors (rad), or translations in metres.
struct ComparedStep {
  urban_nav_core::StampNs to = 0;
  double seconds = 0.0;
  urban_nav_core::Vector3d by_images = urban_nav_core::Vector3d::Zero();
  urban_nav_core::Vector3d by_sensor = urban_nav_core::Vector3d::Zero();  ///< without any correction
  void archive(urban_nav_core::Archive& archive) { archive(to, seconds, by_images, by_sensor); }
};

/// Whether a motion sensor agrees with images that agree among themselves. Steps form blocks of 0.25 s. A block
/// contradicts where the corrected difference is far beyond its standard deviation and more than half of the motion; it
/// confirms where a motion far beyond its standard deviation is met. Blocks of rest do neither. Over the last seconds
/// the scale of the motion must be met as well.
class Agreement {
 public:
  enum class Verdict { Unknown, Agrees, Contradicts };

  /// `floor`: difference over a block that is never held against a sensor, rad or m (standard deviation).
  explicit Agreement(double floor) : floor_(floor) {}

  /// `error`: what is left of the difference after the corrections that are known; `variance`: of it, the sum over the
  /// axes.
  void add(const ComparedStep& step, const urban_nav_core::Vector3d& error, double variance);
  /// The next step does not follow the one before.
  void interrupt();
  /// Starts anew after a contradiction. `was_trusted`: the sensor was in use; the next time it takes twice as long
  /// until it is.
  void restart(bool was_trusted);

  Verdict verdict() const;
  /// Returns the steps of the last seconds.
  const std::vector<ComparedStep>& steps() const { return steps_; }

  void archive(urban_nav_core::Archive& archive);

 private:
  struct Block {
    double seconds = 0.0, variance = 0.0;
    urban_nav_core::Vector3d error = urban_nav_core::Vector3d::Zero(), by_images = error, by_sensor = error;
  };
  void closeBlock();
  bool isOffScale() const;

  double floor_;
  Block block_;
  double contradicted_ = 0.0, confirmed_ = 0.0;  // blocks, older ones for less
  // Sums over blocks, older ones for less: the square of the motion, its product with the error, and the variance of
  // that.
  double motion_ = 0.0, along_ = 0.0, along_variance_ = 0.0;
  double compared_ = 0.0, wanted_ = 0.0;         // s since the last restart, and how many are enough
  int restarts_ = 0;
  std::vector<ComparedStep> steps_;
};

}  // namespace swf_vo
