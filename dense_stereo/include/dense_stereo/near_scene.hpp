// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "dense_stereo/dense_stereo.hpp"
#include "dense_stereo/ground_plane.hpp"
#include "dense_stereo/obstacles.hpp"
#include "dense_stereo/points.hpp"

namespace dense_stereo {

/// Robot's surroundings from one stereo pair. Coordinates are in the left optical frame.
struct NearScene {
  static constexpr int kStep = 2;  ///< px, between points along rows and columns

  StereoResult stereo;             ///< disparities of all pixels
  std::vector<DensePoint> points;  ///< within rangeLimit()
  double near_share = 0.0;         ///< share of the matched pixels within rangeLimit()
  GroundPlane ground;
  std::vector<ObstaclePoint> obstacles;  ///< empty without a ground plane
};

/// Returns the range up to which points are used, m: `max_range`, or the range at which a disparity error of 0.1 px
/// displaces a point by 5 cm if that is farther (Matthies and Shafer 1987), as for cameras with a long baseline.
double rangeLimit(double max_range, const urban_nav_core::StereoCamera& camera);

/// Computes disparities, points, ground plane and obstacles of stereo pairs (Newman et al. 2009, section 6.2).
/// Deterministic; the result of a pair does not depend on earlier pairs. Not thread-safe; different objects are
/// independent.
class NearSceneEstimator {
 public:
  /// `matcher`: null for semi-global matching. Throws UserError like DenseStereo.
  NearSceneEstimator(const Parameters& parameters, const urban_nav_core::StereoCamera& camera,
                     std::unique_ptr<Matcher> matcher = nullptr);

  /// Returns the scene of a rectified pair. `up`: opposite of gravity in the left optical frame; nullopt: the camera is
  /// assumed upright. The result is valid until the next call.
  const NearScene& process(const urban_nav_core::StereoPair& pair, const std::optional<Eigen::Vector3d>& up = {});

 private:
  urban_nav_core::StereoCamera camera_;
  double range_;
  ObstacleOptions obstacles_;
  DenseStereo stereo_;
  NearScene scene_;
};

/// Returns the point with the smallest variance in each cube of `spacing` metres, in the order of their pixels. Pure.
std::vector<DensePoint> thinPoints(const std::vector<DensePoint>& points, double spacing);

}  // namespace dense_stereo
