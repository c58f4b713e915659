// SPDX-License-Identifier: BSD-3-Clause
#include "materials/masonry.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "materials/canvas.hpp"
#include "noise/hash.hpp"

namespace urban_nav_sim {
namespace {

/// Divides `total` exactly into lengths between `low` and `high`; returns the end of each.
std::vector<float> divide(float total, float low, float high, Draw& draw) {
  if (low >= high) {
    const int n = std::max(1, static_cast<int>(std::lround(total / low)));
    std::vector<float> ends(static_cast<std::size_t>(n));
    for (int i = 0; i < n; ++i)
      ends[static_cast<std::size_t>(i)] = total * static_cast<float>(i + 1) / static_cast<float>(n);
    return ends;
  }
  std::vector<float> ends;
  float sum = 0.0F;
  while (sum < total - 0.5F * low) {
    sum += static_cast<float>(draw.uniform(static_cast<double>(low), static_cast<double>(high)));
    ends.push_back(sum);
  }
  for (float& e : ends) e *= total / sum;
  return ends;
}

std::size_t partIndex(const std::vector<float>& ends, float x) {
  return std::min(static_cast<std::size_t>(std::upper_bound(ends.begin(), ends.end(), x) - ends.begin()),
                  ends.size() - 1);
}

struct Course {
  std::vector<float> ends, tones;
  float shift = 0.0F;
};

}  // namespace

std::shared_ptr<const Tile> drawBond(const Bond& bond) {
  Draw draw(hash(bond.seed, 0xB0));
  const bool regular = bond.course_low >= bond.course_high;
  const std::vector<float> rows = divide(bond.period, bond.course_low, bond.course_high, draw);
  std::vector<Course> courses(rows.size());
  for (std::size_t r = 0; r < rows.size(); ++r) {
    courses[r].ends = divide(bond.period, bond.block_low, bond.block_high, draw);
    courses[r].shift =
        regular ? (r % 2 == 1 ? 0.5F * bond.block_low : 0.0F) : static_cast<float>(draw.uniform()) * bond.period;
    for (std::size_t i = 0; i < courses[r].ends.size(); ++i) {
      const double odd = draw.chance(0.06) ? draw.uniform(-3.0, 2.0) : 0.0;
      courses[r].tones.push_back(bond.block_tone * static_cast<float>(std::clamp(draw.normal() + odd, -3.0, 3.0)));
    }
  }
  const int n = bond.size;
  const float texel = bond.period / static_cast<float>(n);
  const int cells = std::max(1, static_cast<int>(bond.period / 0.08F));
  const Canvas grain = fractalNoise(n, cells, cells, 5, 0.8F, hash(bond.seed, 1));
  const Canvas fine = fractalNoise(n, n / 4, n / 4, 2, 1.0F, hash(bond.seed, 2));
  const Canvas wobble = fractalNoise(n, cells, cells, 3, 0.5F, hash(bond.seed, 3));
  Canvas mix(n), tone(n);
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      const float stray = bond.wobble * wobble.at(x, y);
      float u = (static_cast<float>(x) + 0.5F) * texel + stray,
            v = (static_cast<float>(y) + 0.5F) * texel + bond.wobble * wobble.at(y, x);
      if (bond.upright) std::swap(u, v);
      v -= bond.period * std::floor(v / bond.period);
      const std::size_t r = partIndex(rows, v);
      const Course& course = courses[r];
      u += course.shift;
      u -= bond.period * std::floor(u / bond.period);
      const std::size_t b = partIndex(course.ends, u);
      const float below = r == 0 ? 0.0F : rows[r - 1], before = b == 0 ? 0.0F : course.ends[b - 1];
      const float from_edge = std::min({u - before, course.ends[b] - u, v - below, rows[r] - v});
      const float joint = 1.0F - smoothStep(0.5F * bond.joint - texel, 0.5F * bond.joint + texel, from_edge);
      const float low_edge = bond.shade * (1.0F - smoothStep(0.0F, 2.5F * bond.joint + 0.01F, v - below));
      const float pit = bond.pits * smoothStep(1.1F, 2.0F, -fine.at(x, y) - 0.4F * grain.at(x, y));
      const float stone =
          course.tones[b] + bond.grain * grain.at(x, y) + 0.5F * bond.grain * fine.at(x, y) - low_edge - pit;
      mix.at(x, y) = joint;
      tone.at(x, y) = joint * 0.5F * bond.grain * grain.at(x, y) + (1.0F - joint) * stone;
    }
  }
  auto tile = std::make_shared<Tile>(n, bond.period, mix.values(), tone.values());
  if (regular)
    tile->shuffle({bond.upright ? 2.0F * bond.course_low : bond.block_low,
                   bond.upright ? bond.block_low : 2.0F * bond.course_low});
  return tile;
}

std::shared_ptr<const Tile> drawRubble(int stones, float period, std::uint64_t seed) {
  const int n = 1024;
  const Pebbles cells = pebbles(n, stones, 0.75F, hash(seed, 1));
  const Canvas grain = fractalNoise(n, 4 * stones, 4 * stones, 5, 0.75F, hash(seed, 2));
  const Canvas rough = fractalNoise(n, 2 * stones, 2 * stones, 4, 0.6F, hash(seed, 3));
  Canvas mix(n), tone(n);
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      const float edge = cells.edge.at(x, y) + 0.05F * rough.at(x, y);
      const float joint = 1.0F - smoothStep(0.06F, 0.14F, edge);
      const float stone =
          0.9F * (cells.id.at(x, y) - 0.5F) + 0.14F * grain.at(x, y) + 0.12F * (smoothStep(0.1F, 0.5F, edge) - 0.7F);
      mix.at(x, y) = joint;
      tone.at(x, y) = joint * (0.1F * grain.at(x, y) - 0.15F) + (1.0F - joint) * stone;
    }
  }
  return std::make_shared<Tile>(n, period, mix.values(), tone.values());
}

std::shared_ptr<const Tile> drawWindow(int columns, int rows, std::uint64_t seed) {
  const int n = 256;
  const float period = 2.0F;
  Draw draw(hash(seed, 0x3D));
  const Canvas blur = fractalNoise(n, 2, 2, 5, 0.6F, hash(seed, 1));
  const float curtain = static_cast<float>(draw.uniform(0.05, 0.3)), sill = static_cast<float>(draw.uniform(0.1, 0.35));
  std::vector<float> pane_tones;
  for (int i = 0; i < columns * rows; ++i) pane_tones.push_back(static_cast<float>(0.12 * draw.normal()));
  Canvas mix(n), tone(n);
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      const float u = (static_cast<float>(x) + 0.5F) / static_cast<float>(n),
                  v = (static_cast<float>(y) + 0.5F) / static_cast<float>(n);
      const float pu = u * static_cast<float>(columns), pv = v * static_cast<float>(rows);
      const int i = static_cast<int>(pu), j = static_cast<int>(pv);
      const float du =
          std::min(pu - static_cast<float>(i), static_cast<float>(i + 1) - pu) / static_cast<float>(columns);
      const float dv = std::min(pv - static_cast<float>(j), static_cast<float>(j + 1) - pv) / static_cast<float>(rows);
      const float rim = std::min({u, 1.0F - u, v, 1.0F - v});
      const bool sash = rows > 1 && std::abs(v - 0.5F) < 0.022F;
      const bool bar = rim < 0.05F || sash || du < 0.011F || dv < 0.011F;
      mix.at(x, y) = bar ? 1.0F : 0.0F;
      const bool hangs = u < curtain || u > 1.0F - curtain, stands = v < sill && u > 0.35F && u < 0.6F;
      const float interior = (hangs ? 0.35F : -0.2F) + (stands ? 0.3F : 0.0F) + 0.12F * blur.at(x, y) +
                             pane_tones[static_cast<std::size_t>(j * columns + i)];
      tone.at(x, y) = bar ? 0.03F * blur.at(x, y) : interior;
    }
  }
  return std::make_shared<Tile>(n, period, mix.values(), tone.values());
}

}  // namespace urban_nav_sim
