// SPDX-License-Identifier: BSD-3-Clause
#include "materials/material.hpp"

#include <algorithm>

#include "noise/hash.hpp"

namespace urban_nav_sim {
namespace {

// At an elevation of 10 degrees a footprint on the ground is 6 times as long as wide; lower elevations are rare.
constexpr int kMostTaps = 6;
// Albedos of real surfaces; sums of extreme layers may exceed them.
constexpr float kDarkest = 0.015F, kLightest = 0.92F;

/// Returns the texture offset of this instance in shares of a period.
Eigen::Vector2f drawStart(std::uint64_t bits) {
  return {static_cast<float>(bits & 0xFFFFU) / 65536.0F, static_cast<float>((bits >> 16) & 0xFFFFU) / 65536.0F};
}

Footprint scaled(const Footprint& footprint, float factor) {
  Footprint result = footprint;
  result.length *= factor;
  result.width *= factor;
  return result;
}

}  // namespace

Appearance lookAt(const Material& material, const MaterialSample& spot) {
  const Footprint footprint = computeFootprint(spot.per_u, spot.per_v, kMostTaps);
  const std::uint64_t bits = hash(spot.seed);
  Tile::Value detail;
  if (material.detail) {
    const float factor = 1.0F / material.stretch;
    Eigen::Vector2f at = spot.at * factor;
    if (!material.anchored) at += drawStart(bits) * material.detail->period();
    detail = material.detail->read(at, scaled(footprint, factor));
  }
  Appearance look;
  look.albedo =
      material.colours[0] + (material.colours[1] - material.colours[0]) * detail.mix + material.per_tone * detail.tone;
  look.infrared = material.infrareds[0] + (material.infrareds[1] - material.infrareds[0]) * detail.mix +
                  material.infrared_per_tone * detail.tone;
  look.gloss = material.glosses[0] + (material.glosses[1] - material.glosses[0]) * detail.mix;
  look.glass = material.glass[0] + (material.glass[1] - material.glass[0]) * detail.mix;
  float stain = 0.0F;
  // Layers may blur along the long axis: their detail is coarse, and taps would double the time.
  const float width = 0.5F * (footprint.width + footprint.length.norm());
  std::uint64_t more = bits;
  for (const Layer& layer : material.layers) {
    if (!layer.tile) continue;
    more = hash(more);
    const float c = layer.turn.x() / layer.stretch, s = layer.turn.y() / layer.stretch;
    const Eigen::Vector2f at(c * spot.at.x() - s * spot.at.y(), s * spot.at.x() + c * spot.at.y());
    const Tile::Value mean = layer.tile->mean(),
                      value = layer.tile->read(at + drawStart(more) * layer.tile->period(), width / layer.stretch);
    look.albedo += layer.per_tone * (value.tone - mean.tone) + layer.per_mix * (value.mix - mean.mix);
    stain += value.tone - mean.tone;
  }
  look.infrared = std::clamp(look.infrared * (1.0F + 0.5F * stain), kDarkest, kLightest);
  if (spot.wet > 0.0F) {
    const float film = spot.wet * std::clamp(0.6F - 1.5F * stain, 0.0F, 1.0F);  // hollows retain water
    look.albedo *= 1.0F - material.soaks * (0.6F * spot.wet + 0.4F * film);
    look.infrared *= 1.0F - material.soaks * spot.wet;
    look.gloss += (1.0F - look.gloss) * material.shines * film;
  }
  look.albedo = look.albedo.cwiseMax(kDarkest).cwiseMin(kLightest);
  return look;
}

bool isThere(const Material& material, const Eigen::Vector2f& at, std::uint32_t seed, float leaves) {
  if (!material.cut) return true;
  return material.cut->isThere(at / material.stretch + drawStart(hash(seed)) * material.cut->period, leaves);
}

bool hasHoles(const Material& material) { return static_cast<bool>(material.cut); }

}  // namespace urban_nav_sim
