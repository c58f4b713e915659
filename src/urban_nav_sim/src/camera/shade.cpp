// SPDX-License-Identifier: BSD-3-Clause
#include "camera/shade.hpp"

#include <algorithm>
#include <cmath>

namespace urban_nav_sim {
namespace {

using Eigen::Vector3f;

constexpr float kVisibility = 3000.0F;  // m to 1/e of the contrast: a clear day over a town

/// Returns the sunlight on a point; leaves have random angles around that of their card, and transmit light.
float sunOn(const SurfacePoint& point, const Sky& sky) {
  const float cosine = point.normal.dot(sky.day().to_sun);
  if (point.surface_class == SurfaceClass::Foliage) return 0.30F + 0.45F * std::abs(cosine);
  return std::max(cosine, 0.0F);
}

}  // namespace

bool facesSun(const SurfacePoint& point, const Sky& sky) { return sunOn(point, sky) > 0.0F; }

Vector3f shade(const SurfacePoint& point, const Appearance& look, const Vector3f& direction, float sunlit,
               const Vector3f& lamps, const Sky& sky) {
  Vector3f light = sky.ambient(point.normal) + lamps;
  if (sunlit > 0.0F) light += sunlit * sunOn(point, sky) * sky.day().sun;
  Vector3f scattered = look.albedo.cwiseProduct(light);
  if (!(look.gloss > 0.0F)) return scattered;
  // Schlick 1994, with the gloss as the reflectance at normal incidence.
  const float cosine = std::clamp(-direction.dot(point.normal), 0.0F, 1.0F), edge = 1.0F - cosine;
  const float edge2 = edge * edge;
  const float share = look.gloss + (1.0F - look.gloss) * std::min(1.0F, 3.0F * look.gloss) * edge2 * edge2 * edge;
  const Vector3f reflected = direction + 2.0F * cosine * point.normal;
  return (1.0F - share) * scattered + share * sky.mirrored(reflected);
}

Vector3f throughAir(const Vector3f& radiance, float metres, const Sky& sky) {
  const float lost = 1.0F - std::exp(-metres / kVisibility);
  return radiance + lost * (sky.haze() - radiance);
}

}  // namespace urban_nav_sim
