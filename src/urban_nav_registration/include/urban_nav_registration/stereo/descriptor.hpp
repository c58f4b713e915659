// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "urban_nav_core/image/pyramid.hpp"

namespace urban_nav_registration {

/// The descriptor of SIFT (Lowe 2004, section 6): histograms of gradient directions in 4x4 parts of a window, as a unit
/// vector. The window's size is given, and it is upright: depth from stereo knows how large a thing is seen, and a
/// robot on wheels which way is up.
///
/// Own code because OpenCV 4.2 as distributions build it has none, and 4.6's takes ten times as long over a scale space
/// of its own; here gradients are those of a 16x16 grid read from the pyramid that alignment needs anyway.
inline constexpr int kDescriptorSize = 128;
using Descriptors = Eigen::Matrix<float, kDescriptorSize, Eigen::Dynamic>;  ///< one a column

inline constexpr double kLeastWindowPx = 20.0;  ///< of level 0: a grid of less than a pixel a step sees nothing more

/// `centre`, `window` (side, >= kLeastWindowPx): px of level 0. All zero where there is no contrast. What lies outside
/// the image is its border.
Eigen::Matrix<float, kDescriptorSize, 1> describe(const urban_nav_core::Pyramid& pyramid, const Eigen::Vector2d& centre,
                                                  double window);

/// Columns of `a` and `b` that are each other's nearest, clearly nearer than the second nearest on both sides. In the
/// order of a.
struct DescriptorMatch {
  int a = 0, b = 0;
};
std::vector<DescriptorMatch> mutualNearest(const Descriptors& a, const Descriptors& b);
/// Returns such matches of unit vectors of any size, by their inner products: those of `a` in rows, of `b` in columns.
std::vector<DescriptorMatch> mutualNearest(const Eigen::MatrixXf& products);

}  // namespace urban_nav_registration
