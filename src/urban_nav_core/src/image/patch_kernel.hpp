// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/image/patch.hpp"

/// Components of patch alignment, internal to this folder.
namespace urban_nav_core::patch_kernel {

/// Variance of white noise after the spline, mean over the phases (0.25 at 0, 0.21 at 1/2).
inline constexpr double kSmoothedNoise = 0.24;

/// Gaussian weights of the window; zero in the padding.
struct Window {
  Window();
  alignas(16) PatchGrid weight{};
  double total = 0.0;
};
const Window& window();

double dot(const PatchGrid& a, const PatchGrid& b);

/// Returns whether the window at this position, with the spline's margin, lies inside the image.
bool fits(const ImageView& image, double x, double y);

/// Reads the window at a subpixel position through the spline, blurred like the template. Requires fits().
void readWindow(const ImageView& image, double x, double y, const Eigen::Vector2d& blur, PatchGrid& out);

/// Projects offset and gain out of a weighted gradient, which yields a filter.
void makeBlind(const PatchGrid& gradient, const PatchTemplate& patch, PatchGrid& out);

struct Gradients {
  PatchGrid x{}, y{};
};
/// Computes the template as warpTemplate(), with its gradients.
bool makeTemplate(const PatchSource& source, const PatchWarp& warp, PatchTemplate& made, Gradients& gradients);

/// Responses of a window of pixels to the filters of a template.
struct Reading {
  Eigen::Vector2d along = Eigen::Vector2d::Zero();
  double gain = 0.0, mean = 0.0, variance = 0.0;  ///< mean and variance: of the pixels, weighted
};
Reading measure(const PatchGrid& pixels, const PatchTemplate& patch);

}  // namespace urban_nav_core::patch_kernel
