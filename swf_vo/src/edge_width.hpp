// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "urban_nav_core/image/view.hpp"

namespace swf_vo {

/// How wide the steepest edges of an image are, as the variance of a Gaussian, px^2 along rows (x) and columns (y):
/// their slope over their curvature, squared. It says how blurred an image is, whatever its contrast and however many
/// edges it has: a Gaussian of s px adds s^2 to it, within a fifth in streets, half as much again in rendered rooms,
/// and up to three times as much where all edges are straight and alike; a sharp image has about 0.4. Noise makes an
/// image look sharper, never less sharp. Zero without any contrast. Looks at every fourth pixel of every fourth row.
/// Allocates nothing.
Eigen::Vector2d edgeVariance(const urban_nav_core::ImageView& image);

/// How wide the edges of both images are (edgeVariance), px^2; zero: not known.
struct Edges {
  Eigen::Vector2d left = Eigen::Vector2d::Zero(), right = Eigen::Vector2d::Zero();
};

/// By how much edges are wider than others, px^2, each along its axis: zero unless it is a pixel's width more, and more
/// than scenes differ by.
Eigen::Vector2d widening(const Eigen::Vector2d& edges, const Eigen::Vector2d& others);
/// The mean of both images where edges are wider in both of them, along each axis: one of them alone is something else,
/// as a thing with soft edges that only one camera sees.
Eigen::Vector2d widening(const Edges& edges, const Edges& others);

}  // namespace swf_vo
