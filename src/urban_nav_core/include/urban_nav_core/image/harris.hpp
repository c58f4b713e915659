// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/image/view.hpp"

namespace urban_nav_core {

/// The score of Harris and Stephens (1988): det(M) - k trace(M)^2, where M is the mean over a window of 7x7 pixels of
/// the products of the gradients (Iu^2, Iu Iv, Iv^2), in grey levels per pixel; gradients by Sobel's operator / 8.
/// Positive at corners, negative at edges, near zero where there is nothing.
constexpr int kHarrisRadius = 3;   ///< px, half-width of the window
constexpr int kHarrisMargin = 4;   ///< px, that the window and its gradients reach from the pixel
constexpr float kHarrisK = 0.04F;  ///< Harris and Stephens (1988)

/// The structure tensor M of a window.
struct StructureTensor {
  float uu = 0.0F, uv = 0.0F, vv = 0.0F;  ///< (grey levels / px)^2

  float harris() const { return uu * vv - uv * uv - kHarrisK * (uu + vv) * (uu + vv); }
};

/// Returns the structure tensor of the window centred at (u, v), which must be at least kHarrisMargin from every
/// border. Sums are of integers and so are the same on every machine.
StructureTensor structureTensor(const ImageView& image, int u, int v);

}  // namespace urban_nav_core
