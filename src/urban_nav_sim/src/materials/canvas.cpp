// SPDX-License-Identifier: BSD-3-Clause
#include "materials/canvas.hpp"

#include <algorithm>
#include <cmath>

#include "noise/hash.hpp"

namespace urban_nav_sim {
namespace {

std::uint64_t cellHash(std::uint64_t seed, int x, int y) {
  return hash(seed ^ (static_cast<std::uint64_t>(x) * 0x9E3779B1ULL + (static_cast<std::uint64_t>(y) << 32)));
}

void addOctave(Canvas& canvas, int cells_x, int cells_y, float amplitude, std::uint64_t seed) {
  const int n = canvas.size();
  std::vector<float> lattice(static_cast<std::size_t>(cells_x) * static_cast<std::size_t>(cells_y));
  for (int j = 0; j < cells_y; ++j) {
    for (int i = 0; i < cells_x; ++i) {
      lattice[static_cast<std::size_t>(j * cells_x + i)] =
          static_cast<float>(2.0 * toUniform(cellHash(seed, i, j)) - 1.0);
    }
  }
  for (int y = 0; y < n; ++y) {
    const float v = static_cast<float>(y * cells_y) / static_cast<float>(n);
    const int j0 = static_cast<int>(v), j1 = (j0 + 1) % cells_y;
    const float fy = smoothStep(0.0F, 1.0F, v - static_cast<float>(j0));
    const float* row0 = &lattice[static_cast<std::size_t>(j0 * cells_x)];
    const float* row1 = &lattice[static_cast<std::size_t>(j1 * cells_x)];
    for (int x = 0; x < n; ++x) {
      const float u = static_cast<float>(x * cells_x) / static_cast<float>(n);
      const int i0 = static_cast<int>(u), i1 = i0 + 1 == cells_x ? 0 : i0 + 1;
      const float fx = smoothStep(0.0F, 1.0F, u - static_cast<float>(i0));
      const float top = row0[i0] + fx * (row0[i1] - row0[i0]), bottom = row1[i0] + fx * (row1[i1] - row1[i0]);
      canvas.at(x, y) += amplitude * (top + fy * (bottom - top));
    }
  }
}

}  // namespace

float smoothStep(float low, float high, float x) {
  const float t = std::clamp((x - low) / (high - low), 0.0F, 1.0F);
  return t * t * (3.0F - 2.0F * t);
}

void standardise(Canvas& canvas) {
  double sum = 0.0, square = 0.0;
  for (const float v : canvas.values()) {
    sum += static_cast<double>(v);
    square += static_cast<double>(v) * static_cast<double>(v);
  }
  const double count = static_cast<double>(canvas.values().size()), mean = sum / count;
  const double scale = 1.0 / std::sqrt(std::max(square / count - mean * mean, 1e-12));
  for (float& v : canvas.values()) v = static_cast<float>((static_cast<double>(v) - mean) * scale);
}

Canvas fractalNoise(int size, int cells_x, int cells_y, int octaves, float gain, std::uint64_t seed) {
  Canvas canvas(size);
  float amplitude = 1.0F;
  for (int i = 0; i < octaves && std::max(cells_x, cells_y) << i <= size; ++i, amplitude *= gain) {
    addOctave(canvas, cells_x << i, cells_y << i, amplitude, hash(seed, static_cast<std::uint64_t>(i)));
  }
  standardise(canvas);
  return canvas;
}

Pebbles pebbles(int size, int cells, float jitter, std::uint64_t seed) {
  struct Point {
    float x, y, id;
  };
  std::vector<Point> points;
  points.reserve(static_cast<std::size_t>(cells) * static_cast<std::size_t>(cells));
  for (int j = 0; j < cells; ++j) {
    for (int i = 0; i < cells; ++i) {
      Draw draw(cellHash(seed, i, j));
      const double x = 0.5 + static_cast<double>(jitter) * (draw.uniform() - 0.5),
                   y = 0.5 + static_cast<double>(jitter) * (draw.uniform() - 0.5);
      points.push_back({static_cast<float>(x), static_cast<float>(y), static_cast<float>(draw.uniform())});
    }
  }
  Pebbles result{Canvas(size), Canvas(size)};
  for (int py = 0; py < size; ++py) {
    for (int px = 0; px < size; ++px) {
      const float u = (static_cast<float>(px) + 0.5F) * static_cast<float>(cells) / static_cast<float>(size);
      const float v = (static_cast<float>(py) + 0.5F) * static_cast<float>(cells) / static_cast<float>(size);
      const int i = static_cast<int>(u), j = static_cast<int>(v);
      float nearest = 9.0F, second = 9.0F, id = 0.0F;
      for (int dj = -1; dj <= 1; ++dj) {
        for (int di = -1; di <= 1; ++di) {
          const Point& p =
              points[static_cast<std::size_t>(((j + dj + cells) % cells) * cells + (i + di + cells) % cells)];
          const float dx = static_cast<float>(i + di) + p.x - u, dy = static_cast<float>(j + dj) + p.y - v;
          const float square = dx * dx + dy * dy;
          if (square < nearest) {
            second = nearest, nearest = square, id = p.id;
          } else {
            second = std::min(second, square);
          }
        }
      }
      result.edge.at(px, py) = std::sqrt(second) - std::sqrt(nearest);
      result.id.at(px, py) = id;
    }
  }
  return result;
}

}  // namespace urban_nav_sim
