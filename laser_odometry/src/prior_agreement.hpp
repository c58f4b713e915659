// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "motion.hpp"

namespace laser_odometry {

/// A step by the sweeps and by another sensor (MotionPrior), T_from_to with covariances as in PoseWithCovariance.
struct ComparedStep {
  double seconds = 0.0;
  Pose by_sweeps, by_prior;
  Matrix6d covariance_by_sweeps = Matrix6d::Zero(), covariance_by_prior = Matrix6d::Zero();
};

/// Decides whether the motion by another sensor is consistent with the sweeps, along the directions that both ends of a
/// step measure. Differences are summed over blocks of half a second: a block contradicts if the difference is beyond
/// four standard deviations and a tenth of the motion, and confirms if there was motion without contradiction. Blocks
/// at rest are neutral.
class PriorAgreement {
 public:
  /// Names the sensors of the next prior: priors of other sensors are assessed anew.
  void follow(const std::string& source);
  /// Returns whether one step contradicts by half of the motion, as by a frozen sensor or one in other units. `free`:
  /// twists in base_link that the end of the step leaves free.
  bool isFarFrom(const ComparedStep& step, const std::vector<Vector6d>& free) const;
  /// Adds the next step. `free`: as above.
  void add(const ComparedStep& step, const std::vector<Vector6d>& free);
  /// Marks a step that cannot be compared. `free`: of its end.
  void interrupt(const std::vector<Vector6d>& free);

  /// Returns whether the prior is left out: it contradicted, and has not been confirmed for long enough since.
  bool isLeftOut() const { return left_out_; }
  /// Returns the contradiction for the status: "moves 0.52 m where the sweeps measure 0.40 m".
  const std::string& sentence() const { return sentence_; }

  void archive(urban_nav_core::Archive& archive);

 private:
  struct Block {
    double seconds = 0.0;
    Vector6d by_sweeps = Vector6d::Zero(), by_prior = Vector6d::Zero();  ///< sums of twists along measured directions
    double position_variance = 0.0, turn_variance = 0.0;
    void archive(urban_nav_core::Archive& archive) {
      archive(seconds, by_sweeps, by_prior, position_variance, turn_variance);
    }
  };
  Block measure(const ComparedStep& step, const std::vector<Vector6d>& free) const;
  void closeBlock();

  std::string source_;
  std::vector<Vector6d> free_before_;
  Block block_;
  double contradicted_ = 0.0, confirmed_ = 0.0;  ///< numbers of blocks, exponentially weighted
  double agreeing_s_ = 0.0, required_s_ = 0.0;   ///< since the prior was left out, and until it is used again
  bool left_out_ = false;
  std::string sentence_;
};

}  // namespace laser_odometry
