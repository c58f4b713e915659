// SPDX-License-Identifier: BSD-3-Clause
#include "materials/ground_tiles.hpp"

#include <algorithm>
#include <cmath>

#include "materials/canvas.hpp"
#include "noise/hash.hpp"

namespace urban_nav_sim {
namespace {

constexpr int kSize = 1024;

std::shared_ptr<const Tile> makeTile(float period, const Canvas& mix, const Canvas& tone) {
  return std::make_shared<Tile>(tone.size(), period, mix.values(), tone.values());
}

/// Scatters `count` spots with a radius of `low` to `high` texels over both canvases.
void scatter(Canvas& mix, Canvas& tone, int count, double low, double high, float mix_value, double tone_spread,
             std::uint64_t seed) {
  Draw draw(seed);
  for (int i = 0; i < count; ++i) {
    const double cx = draw.uniform(0, mix.size()), cy = draw.uniform(0, mix.size()), r = draw.uniform(low, high);
    const double stretch = draw.uniform(0.6, 1.0), angle = draw.uniform(0, 3.1416), c = std::cos(angle),
                 s = std::sin(angle);
    const float value = static_cast<float>(tone_spread * draw.normal());
    const int reach = static_cast<int>(r) + 1;
    for (int y = -reach; y <= reach; ++y) {
      for (int x = -reach; x <= reach; ++x) {
        const double u = c * x + s * y, v = (c * y - s * x) / stretch;
        if (u * u + v * v > r * r) continue;
        const int px = static_cast<int>(cx) + x, py = static_cast<int>(cy) + y;
        mix.at(px, py) = mix_value;
        tone.at(px, py) = value + static_cast<float>(0.25 * v / r);
      }
    }
  }
}

}  // namespace

std::shared_ptr<const Tile> drawGrass(std::uint64_t seed) {
  const float period = 3.3F;  // texels of 3.2 mm: a blade
  const Canvas tufts = fractalNoise(kSize, 24, 24, 4, 0.7F, hash(seed, 1)),
               dry = fractalNoise(kSize, 10, 10, 5, 0.7F, hash(seed, 2));
  Canvas mix(kSize), tone(kSize);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) tone.at(x, y) = -0.35F + 0.08F * tufts.at(x, y);
  }
  Draw draw(hash(seed, 3));
  for (int i = 0; i < 60000; ++i) {
    const double cx = draw.uniform(0, kSize), cy = draw.uniform(0, kSize), angle = draw.uniform(0, 6.2832),
                 length = draw.uniform(6, 20);
    const double bend = draw.uniform(-0.06, 0.06);
    const int ix = static_cast<int>(cx), iy = static_cast<int>(cy);
    const float light = static_cast<float>(0.05 + 0.2 * draw.normal()) + 0.16F * tufts.at(ix, iy);
    const float share = std::clamp(0.3F + 0.35F * dry.at(ix, iy) + static_cast<float>(0.2 * draw.normal()), 0.0F, 1.0F);
    double x = cx, y = cy, a = angle;
    for (double s = 0; s < length; s += 0.7, a += bend) {
      x += 0.7 * std::cos(a), y += 0.7 * std::sin(a);
      const int px = static_cast<int>(std::floor(x)), py = static_cast<int>(std::floor(y));
      tone.at(px, py) = light + static_cast<float>(0.25 * (s / length - 0.5));
      mix.at(px, py) = share;
    }
  }
  scatter(mix, tone, 120, 2.0, 5.0, 1.0F, 0.4, hash(seed, 4));  // clover heads, fallen leaves
  return makeTile(period, mix, tone);
}

std::shared_ptr<const Tile> drawGravel(std::uint64_t seed) {
  const Pebbles large = pebbles(kSize, 110, 0.9F, hash(seed, 1)), small = pebbles(kSize, 260, 0.9F, hash(seed, 2));
  const Canvas which = fractalNoise(kSize, 40, 40, 3, 0.7F, hash(seed, 3)),
               drift = fractalNoise(kSize, 8, 8, 5, 0.7F, hash(seed, 4));
  Canvas mix(kSize), tone(kSize);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const Pebbles& p = which.at(x, y) > 0.2F ? large : small;
      const float edge = p.edge.at(x, y);
      mix.at(x, y) = 1.0F - smoothStep(0.05F, 0.2F, edge);
      tone.at(x, y) =
          0.35F * (p.id.at(x, y) - 0.5F) + 0.1F * (smoothStep(0.1F, 0.6F, edge) - 0.5F) + 0.05F * drift.at(x, y);
    }
  }
  scatter(mix, tone, 260, 3.0, 9.0, 0.0F, 0.35, hash(seed, 5));
  return makeTile(2.6F, mix, tone);
}

std::shared_ptr<const Tile> drawAsphalt(std::uint64_t seed) {
  const Pebbles chips = pebbles(kSize, 300, 1.0F, hash(seed, 1));
  const Canvas wear = fractalNoise(kSize, 6, 6, 7, 0.75F, hash(seed, 2)),
               crack = fractalNoise(kSize, 5, 5, 5, 0.55F, hash(seed, 3));
  Canvas mix(kSize), tone(kSize);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const float chip = smoothStep(0.6F, 0.95F, chips.id.at(x, y)) * smoothStep(0.08F, 0.25F, chips.edge.at(x, y));
      const float line = wear.at(x, y) > -0.3F ? 1.0F - smoothStep(0.0F, 0.03F, std::abs(crack.at(x, y))) : 0.0F;
      mix.at(x, y) = std::clamp(chip * (0.8F + 0.25F * wear.at(x, y)), 0.0F, 1.0F);
      tone.at(x, y) = 0.2F * (chips.id.at(x, y) - 0.5F) + 0.1F * wear.at(x, y) - 0.45F * line;
    }
  }
  scatter(mix, tone, 60, 2.0, 7.0, 0.2F, 0.5, hash(seed, 4));  // gum, stones
  return makeTile(3.0F, mix, tone);
}

std::shared_ptr<const Tile> drawSoil(std::uint64_t seed) {
  const Canvas lumps = fractalNoise(kSize, 30, 30, 6, 0.85F, hash(seed, 1)),
               drift = fractalNoise(kSize, 5, 5, 5, 0.6F, hash(seed, 2));
  Canvas mix(kSize), tone(kSize);
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) tone.at(x, y) = 0.13F * lumps.at(x, y) + 0.06F * drift.at(x, y);
  }
  scatter(mix, tone, 2600, 1.5, 5.0, 1.0F, 0.35, hash(seed, 3));
  scatter(mix, tone, 260, 5.0, 11.0, 0.7F, 0.35, hash(seed, 4));
  return makeTile(2.8F, mix, tone);
}

std::shared_ptr<const Tile> drawClouds(std::uint64_t seed) {
  const Canvas a = fractalNoise(512, 4, 4, 7, 0.62F, hash(seed, 1)),
               b = fractalNoise(512, 5, 5, 7, 0.62F, hash(seed, 2));
  Canvas mix(512), tone(512);
  for (int y = 0; y < 512; ++y) {
    for (int x = 0; x < 512; ++x) mix.at(x, y) = 0.5F + 0.15F * a.at(x, y), tone.at(x, y) = 0.3F * b.at(x, y);
  }
  return makeTile(8.0F, mix, tone);
}

std::shared_ptr<const Tile> drawStreaks(std::uint64_t seed) {
  const Canvas a = fractalNoise(512, 24, 3, 5, 0.7F, hash(seed, 1)),
               b = fractalNoise(512, 8, 5, 6, 0.65F, hash(seed, 2));
  Canvas mix(512), tone(512);
  for (int y = 0; y < 512; ++y) {
    for (int x = 0; x < 512; ++x) {
      const float run = smoothStep(0.2F, 2.0F, a.at(x, y) + 0.5F * b.at(x, y));
      mix.at(x, y) = run, tone.at(x, y) = 0.3F * b.at(x, y) - 0.5F * run + 0.08F;
    }
  }
  standardise(tone);
  for (float& t : tone.values()) t *= 0.3F;
  return makeTile(8.0F, mix, tone);
}

std::shared_ptr<const Tile> drawPlaster(std::uint64_t seed) {
  const Canvas fine = fractalNoise(512, 128, 128, 3, 0.9F, hash(seed, 1)),
               broad = fractalNoise(512, 5, 5, 7, 0.6F, hash(seed, 2));
  const Canvas crack = fractalNoise(512, 3, 3, 6, 0.55F, hash(seed, 3));
  Canvas mix(512), tone(512);
  for (int y = 0; y < 512; ++y) {
    for (int x = 0; x < 512; ++x) {
      const float line = broad.at(x, y) > 0.6F ? 1.0F - smoothStep(0.0F, 0.03F, std::abs(crack.at(x, y))) : 0.0F;
      const float chip = smoothStep(2.1F, 2.5F, broad.at(x, y) + 0.5F * fine.at(x, y));
      mix.at(x, y) = std::max(line, chip);
      tone.at(x, y) = 0.12F * fine.at(x, y) + 0.16F * broad.at(x, y);
    }
  }
  return makeTile(2.4F, mix, tone);
}

}  // namespace urban_nav_sim
