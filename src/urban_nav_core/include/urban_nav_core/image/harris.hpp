// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/image/view.hpp"

namespace urban_nav_core {

/// Corner score of Harris and Stephens (1988): det(M) - k trace(M)^2. M is the mean over a 7x7 window of the gradient
/// products (Iu^2, Iu Iv, Iv^2), in grey levels per pixel; gradients by Sobel's operator / 8. Positive at corners,
/// negative at edges, near zero in regions without texture.
constexpr int kHarrisRadius = 3;   ///< px, half-width of the window
constexpr int kHarrisMargin = 4;   ///< px, extent of the window with its gradients
constexpr float kHarrisK = 0.04F;  ///< Harris and Stephens (1988)

/// Structure tensor M of a window.
struct StructureTensor {
  float uu = 0.0F, uv = 0.0F, vv = 0.0F;  ///< (grey levels / px)^2

  float harris() const { return uu * vv - uv * uv - kHarrisK * (uu + vv) * (uu + vv); }
};

/// Returns the structure tensor of the window centred at (u, v), which must be at least kHarrisMargin from every
/// border. Sums are integers, hence the same on every machine.
StructureTensor structureTensor(const ImageView& image, int u, int v);

}  // namespace urban_nav_core
