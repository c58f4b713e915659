// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/laser/reflectance.hpp"

#include <algorithm>
#include <cmath>

namespace urban_nav_core {

float normaliseReflectance(float raw, float range, float cosine) {
  const float optics = range / (range + 0.5F), distance = range > 8.0F ? 8.0F / range : 1.0F;
  const float lambert = std::pow(std::clamp(cosine, 0.2F, 1.0F), 0.85F);
  return std::clamp(raw / (std::max(optics, 0.1F) * distance * lambert), 0.0F, 255.0F);
}

}  // namespace urban_nav_core
