// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "urban_nav_core/geometry/so3.hpp"
#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_core {

/// Motion over one step by the reference (odometry by images or sweeps) and by a sensor: rotation vectors (rad), or
/// translations (m).
struct ComparedStep {
  StampNs to = 0;
  double seconds = 0.0;
  Vector3d by_reference = Vector3d::Zero();
  Vector3d by_sensor = Vector3d::Zero();  ///< without any correction
  void archive(Archive& archive) { archive(to, seconds, by_reference, by_sensor); }
};

/// Tests whether a motion sensor is consistent with the reference. Steps are summed over blocks of 0.25 s. A block
/// contradicts if the corrected difference is far beyond its standard deviation and more than half of the motion; it
/// confirms if a motion far beyond its standard deviation is matched. Blocks without motion are neutral. The scale of
/// the motion over the last seconds must match as well.
class Agreement {
 public:
  enum class Verdict { Unknown, Agrees, Contradicts };

  /// `floor`: difference over a block that is always tolerated, rad or m (standard deviation).
  explicit Agreement(double floor) : floor_(floor) {}

  /// `error`: difference after the estimated corrections; `variance`: its variance, summed over the axes.
  void add(const ComparedStep& step, const Vector3d& error, double variance);
  /// Marks a gap: the next step does not follow the previous one.
  void interrupt();
  /// Restarts after a contradiction. `was_trusted`: the sensor was in use; the required time until it is used again
  /// doubles.
  void restart(bool was_trusted);

  Verdict verdict() const;
  /// Returns whether the steps since the last restart are too short for a verdict.
  bool isUntested() const;
  /// Returns the steps of the last seconds.
  const std::vector<ComparedStep>& steps() const { return steps_; }

  void archive(Archive& archive);

 private:
  struct Block {
    double seconds = 0.0, variance = 0.0;
    Vector3d error = Vector3d::Zero(), by_reference = error, by_sensor = error;
  };
  void closeBlock();
  bool isOffScale() const;

  double floor_;
  Block block_;
  double contradicted_ = 0.0, confirmed_ = 0.0;  // numbers of blocks, exponentially weighted
  // Exponentially weighted sums over blocks: squared motion, its product with the error, and the variance of that
  // product.
  double motion_ = 0.0, along_ = 0.0, along_variance_ = 0.0;
  double compared_ = 0.0, wanted_ = 0.0;  // s since the last restart, and the required time
  int restarts_ = 0;
  std::vector<ComparedStep> steps_;
};

}  // namespace urban_nav_core
