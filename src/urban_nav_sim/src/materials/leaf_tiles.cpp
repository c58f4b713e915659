// SPDX-License-Identifier: BSD-3-Clause
#include "materials/leaf_tiles.hpp"

#include <algorithm>
#include <cmath>

#include "materials/canvas.hpp"
#include "noise/hash.hpp"

namespace urban_nav_sim {
namespace {

struct Drawn {
  Canvas mix, tone;
  std::vector<std::uint8_t> ranks;
};

/// `blossoms`: share of leaves of the second colour; 0: each leaf has a colour between the two.
Drawn leavesOn(int size, float texel, int count, double low, double high, float background, double blossoms,
               std::uint64_t seed) {
  Drawn drawn{Canvas(size, 0.4F), Canvas(size, background),
              std::vector<std::uint8_t>(static_cast<std::size_t>(size) * static_cast<std::size_t>(size), 0)};
  Draw draw(seed);
  for (int i = 0; i < count; ++i) {
    const double cx = draw.uniform(0, size), cy = draw.uniform(0, size),
                 half = 0.5 * draw.uniform(low, high) / static_cast<double>(texel);
    const double angle = draw.uniform(0, 6.2832), c = std::cos(angle), s = std::sin(angle),
                 slim = draw.uniform(0.45, 0.75);
    // Later leaves lie above earlier ones and receive more light.
    const double light = -0.3 + 0.5 * i / count + 0.22 * draw.normal();
    const double between = std::clamp(0.4 + 0.3 * draw.normal(), 0.0, 1.0);
    const float share = static_cast<float>(blossoms > 0.0 ? (draw.chance(blossoms) ? 1.0 : 0.0) : between);
    const auto rank = static_cast<std::uint8_t>(1 + draw.index(255));
    const int reach = static_cast<int>(half) + 1;
    for (int y = -reach; y <= reach; ++y) {
      for (int x = -reach; x <= reach; ++x) {
        const double u = (c * x + s * y) / half, v = (c * y - s * x) / half;
        const double rim = slim * (1.0 - u * u);
        if (std::abs(u) > 1.0 || std::abs(v) > rim) continue;
        const int px = (static_cast<int>(cx) + x) & (size - 1), py = (static_cast<int>(cy) + y) & (size - 1);
        const double vein = std::abs(v) * half < 0.7 ? 0.12 : 0.0;
        drawn.tone.at(px, py) = static_cast<float>(light + vein + (v > 0 ? 0.1 : -0.05));
        drawn.mix.at(px, py) = share;
        drawn.ranks[static_cast<std::size_t>(py * size + px)] = rank;
      }
    }
  }
  return drawn;
}

}  // namespace

bool Cut::isThere(const Eigen::Vector2f& at, float leaves) const {
  const float scale = static_cast<float>(size) / period;
  const int x = static_cast<int>(std::floor(at.x() * scale)) & (size - 1),
            y = static_cast<int>(std::floor(at.y() * scale)) & (size - 1);
  const std::uint8_t rank = ranks[static_cast<std::size_t>(y * size + x)];
  return rank > 0 && static_cast<float>(rank) <= leaves * 255.0F;
}

Leaves drawLeaves(int count, double low, double high, std::uint64_t seed) {
  const Cut shape;
  Drawn drawn = leavesOn(shape.size, shape.period / static_cast<float>(shape.size), count, low, high, 0.0F, 0.0, seed);
  auto cut = std::make_shared<Cut>(shape);
  cut->ranks = std::move(drawn.ranks);
  return {std::make_shared<Tile>(shape.size, shape.period, drawn.mix.values(), drawn.tone.values()), cut};
}

std::shared_ptr<const Tile> drawHedge(double blossoms, std::uint64_t seed) {
  const int size = 1024;
  const float period = 3.0F;
  Drawn drawn = leavesOn(size, period / static_cast<float>(size), 26000, 0.025, 0.06, -0.5F, blossoms, seed);
  const Canvas depth = fractalNoise(size, 16, 16, 4, 0.7F, hash(seed, 5));
  for (std::size_t i = 0; i < drawn.tone.values().size(); ++i) {
    const float hole = smoothStep(0.8F, 1.8F, depth.values()[i]);
    drawn.tone.values()[i] += 0.1F * depth.values()[i] - 0.45F * hole;
  }
  return std::make_shared<Tile>(size, period, drawn.mix.values(), drawn.tone.values());
}

std::shared_ptr<const Tile> drawBark(std::uint64_t seed) {
  const int size = 512;
  const Canvas ridges = fractalNoise(size, 28, 5, 5, 0.7F, hash(seed, 1)),
               moss = fractalNoise(size, 5, 4, 5, 0.6F, hash(seed, 2));
  Canvas mix(size), tone(size);
  for (std::size_t i = 0; i < tone.values().size(); ++i) {
    mix.values()[i] = smoothStep(0.4F, 1.5F, moss.values()[i]);
    tone.values()[i] =
        0.3F * ridges.values()[i] - 0.4F * smoothStep(0.8F, 1.6F, -ridges.values()[i]) + 0.05F * moss.values()[i];
  }
  return std::make_shared<Tile>(size, 1.6F, mix.values(), tone.values());
}

}  // namespace urban_nav_sim
