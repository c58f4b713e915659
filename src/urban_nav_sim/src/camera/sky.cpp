// SPDX-License-Identifier: BSD-3-Clause
#include "camera/sky.hpp"

#include <algorithm>
#include <cmath>

#include "noise/noise.hpp"
#include "urban_nav_core/parallel/for_each.hpp"

namespace urban_nav_sim {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr int kColumns = 2048, kRows = 512;  // 0.18 deg: a pixel of the stereo camera sees 0.15
constexpr float kTurn = 6.2831853F, kQuarter = 1.5707963F;

float smooth(float low, float high, float x) {
  const float t = std::clamp((x - low) / (high - low), 0.0F, 1.0F);
  return t * t * (3.0F - 2.0F * t);
}

/// Returns value noise on the integer lattice, 0 ... 1.
float lattice(const Noise& noise, const Vector2f& at) {
  const float fx = std::floor(at.x()), fy = std::floor(at.y());
  const float u = smooth(0.0F, 1.0F, at.x() - fx), v = smooth(0.0F, 1.0F, at.y() - fy);
  const auto corner = [&](int i, int j) {
    const auto x = static_cast<std::uint32_t>(static_cast<std::int32_t>(fx) + i);
    const auto y = static_cast<std::uint32_t>(static_cast<std::int32_t>(fy) + j);
    return static_cast<float>(noise.uniform(static_cast<std::uint64_t>(x) << 32 | y));
  };
  const float above = (1.0F - u) * corner(0, 0) + u * corner(1, 0),
              below = (1.0F - u) * corner(0, 1) + u * corner(1, 1);
  return (1.0F - v) * above + v * below;
}

/// Returns noise of six octaves, 0 ... 1; those finer than `resolution` fade to their mean over a pixel.
float fractal(const Noise& noise, Vector2f at, float resolution) {
  float sum = 0.0F, weight = 0.5F, total = 0.0F, size = 1.0F;
  for (std::uint64_t octave = 0; octave < 6; ++octave) {
    const float seen = 1.0F - smooth(0.25F * size, 0.7F * size, resolution);
    sum += weight * (0.5F + seen * (lattice(noise.of(octave), at) - 0.5F));
    total += weight;
    at = Vector2f(1.6F * at.x() + 1.2F * at.y() + 17.3F, -1.2F * at.x() + 1.6F * at.y() + 9.1F);
    weight *= 0.5F;
    size *= 0.5F;
  }
  return sum / total;
}

}  // namespace

Sky::Sky(const Day& day, std::uint64_t seed) : day_(day) {
  map_.resize(static_cast<std::size_t>(kRows) * (kColumns + 1));
  urban_nav_core::forEach(kRows, 16, [&](std::size_t row) {
    const float elevation = static_cast<float>(row) / (kRows - 1) * kQuarter, level = std::cos(elevation);
    Vector3f* colours = &map_[row * (kColumns + 1)];
    for (int column = 0; column < kColumns; ++column) {
      const float azimuth = static_cast<float>(column) / kColumns * kTurn;
      colours[column] = evaluate({level * std::cos(azimuth), level * std::sin(azimuth), std::sin(elevation)}, seed);
    }
    colours[kColumns] = colours[0];
  });
  for (int column = 0; column < kColumns; ++column) haze_ += map_[static_cast<std::size_t>(column)] / kColumns;
}

Sky::Sky(const World& world, std::uint64_t seed) : Sky(world.day, seed) { lights_ = Lights(world); }

Vector3f Sky::evaluate(const Vector3f& direction, std::uint64_t seed) const {
  const float z = std::max(direction.z(), 0.0F);
  // Paler and about twice as bright at the horizon as overhead; the mean over the dome stays about day.sky.
  const float low = (1.0F - z) * (1.0F - z) * (1.0F - z) * (1.0F - z);
  const Vector3f pale = Vector3f::Constant(1.15F * day_.sky.mean()) - 0.85F * day_.sky;
  const Vector3f blue = (0.72F + 0.55F * low) * day_.sky + 0.75F * low * pale;

  const float angle = std::acos(std::clamp(direction.dot(day_.to_sun), -1.0F, 1.0F));  // rad
  Vector3f glow = day_.sun * (0.35F * std::exp(-angle / 0.12F) + 0.12F * std::exp(-angle / 0.5F));
  if (angle < 0.006F) glow += 200.0F * day_.sun;

  // A layer of clouds at unit height, bent down towards the horizon.
  const Noise noise(seed, "clouds");
  const Vector2f at = direction.head<2>() / (z + 0.12F) * 1.3F;
  const float resolution = 0.004F / (z + 0.12F);
  const float shape = fractal(noise, at, resolution);
  const float limit = 0.78F - 0.56F * day_.clouds;  // the noise has median 0.5
  const float cover = smooth(limit - 0.03F, limit + 0.09F, shape);
  const float thick = smooth(limit + 0.02F, limit + 0.30F, shape);  // dark from below, with translucent rims
  const float relief = fractal(noise.of("relief"), 3.0F * at, 3.0F * resolution) - 0.5F;
  const Vector3f lit = 0.62F * day_.sun + 1.2F * day_.sky;
  const Vector3f cloud = lit * (1.0F - 0.55F * thick + 0.25F * relief) + 0.3F * glow;
  const float share =
      cover * (0.35F + 0.65F * smooth(0.0F, 0.12F, z));  // the distant part of the layer fades into haze
  return (1.0F - share) * (blue + glow) + share * cloud;
}

Vector3f Sky::sample(const Vector3f& direction) const {
  const float elevation = std::asin(std::clamp(direction.z(), 0.0F, 1.0F));
  float azimuth = std::atan2(direction.y(), direction.x());
  if (azimuth < 0.0F) azimuth += kTurn;
  const float x = std::min(azimuth / kTurn * kColumns, kColumns - 1e-3F);
  const float y = std::min(elevation / kQuarter * (kRows - 1), kRows - 1.001F);
  const auto column = static_cast<std::size_t>(x), row = static_cast<std::size_t>(y);
  const float u = x - static_cast<float>(column), v = y - static_cast<float>(row);
  const Vector3f* p = &map_[row * (kColumns + 1) + column];
  return (1.0F - v) * ((1.0F - u) * p[0] + u * p[1]) + v * ((1.0F - u) * p[kColumns + 1] + u * p[kColumns + 2]);
}

Vector3f Sky::radiance(const Vector3f& direction) const { return direction.z() > 0.0F ? sample(direction) : haze_; }

Vector3f Sky::mirrored(const Vector3f& direction) const {
  const Vector3f outline = 0.35F * day_.ground + 0.12F * (day_.sun + day_.sky);
  const Vector3f paved = 0.25F * (day_.sky + 0.4F * day_.sun);
  const float above_roofs = smooth(0.18F, 0.30F, direction.z());
  const float below = smooth(-0.05F, -0.15F, direction.z());
  Vector3f seen = outline;
  if (above_roofs > 0.0F) seen += above_roofs * (sample(direction).cwiseMin(3.0F) - outline);
  return (1.0F - below) * seen + below * paved;
}

}  // namespace urban_nav_sim
