// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/image/patch.hpp"

/// What the alignments of patches are made of; for the files of this folder alone.
namespace urban_nav_core::patch_kernel {

/// Variance left of white noise by the spline, mean over the phases (0.25 at 0, 0.21 at 1/2).
inline constexpr double kSmoothedNoise = 0.24;

/// The Gaussian weights of the window; zero in the padding.
struct Window {
  Window();
  alignas(16) PatchGrid weight{};
  double total = 0.0;
};
const Window& window();

double dot(const PatchGrid& a, const PatchGrid& b);

/// May the window, with the spline's margin, stand at this position?
bool fits(const ImageView& image, double x, double y);

/// The window at a sub-pixel position, read through the spline and as blurred as the template. Needs fits().
void readWindow(const ImageView& image, double x, double y, const Eigen::Vector2d& blur, PatchGrid& out);

/// Takes out of a gradient what an offset or a gain would explain, and weighs it: a filter.
void makeBlind(const PatchGrid& gradient, const PatchTemplate& patch, PatchGrid& out);

struct Gradients {
  PatchGrid x{}, y{};
};
/// warpTemplate, with the gradients.
bool makeTemplate(const PatchSource& source, const PatchWarp& warp, PatchTemplate& made, Gradients& gradients);

/// A window of pixels through the filters of a template.
struct Reading {
  Eigen::Vector2d along = Eigen::Vector2d::Zero();
  double gain = 0.0, mean = 0.0, variance = 0.0;  ///< mean and variance: of the pixels, weighted
};
Reading measure(const PatchGrid& pixels, const PatchTemplate& patch);

}  // namespace urban_nav_core::patch_kernel
