// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "urban_nav_core/image/pyramid.hpp"

namespace urban_nav_registration {

/// SIFT descriptor (Lowe 2004, section 6): histograms of gradient directions in 4x4 parts of a window, as a unit
/// vector. Scale and orientation are not detected: the size of the window follows from stereo depth, and a wheeled
/// robot is upright.
///
/// Own code because OpenCV 4.2 as packaged by distributions does not include SIFT, and that of 4.6 takes ten times as
/// long, with its own scale space; here gradients are taken from a 16x16 grid of the pyramid that alignment needs
/// anyway.
inline constexpr int kDescriptorSize = 128;
using Descriptors = Eigen::Matrix<float, kDescriptorSize, Eigen::Dynamic>;  ///< one per column

inline constexpr double kLeastWindowPx = 20.0;  ///< px of level 0; a grid with a smaller step adds no information

/// Computes the descriptor of a square window with side `window` (>= kLeastWindowPx), px of level 0. All zero without
/// contrast. Pixels outside the image are replaced by its border.
Eigen::Matrix<float, kDescriptorSize, 1> describe(const urban_nav_core::Pyramid& pyramid, const Eigen::Vector2d& centre,
                                                  double window);

/// Mutual nearest neighbours of the columns of `a` and `b`, clearly nearer than the second nearest on both sides. In
/// the order of a.
struct DescriptorMatch {
  int a = 0, b = 0;
};
std::vector<DescriptorMatch> mutualNearest(const Descriptors& a, const Descriptors& b);
/// Returns the mutual nearest neighbours of unit vectors of any size from their inner products, `a` in rows and `b` in
/// columns.
std::vector<DescriptorMatch> mutualNearest(const Eigen::MatrixXf& products);

}  // namespace urban_nav_registration
