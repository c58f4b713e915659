// SPDX-License-Identifier: BSD-3-Clause
#include "world/day.hpp"

#include <cmath>

#include "noise/hash.hpp"

namespace urban_nav_sim {

Day makeDay(std::uint32_t seed, int number) {
  Draw draw(hash(seed, 0xDA1, static_cast<std::uint64_t>(number)));
  Day day;
  day.number = number;
  // The first day is fine; the others are random, every third one wet, every fourth one in winter.
  const bool fine = number == 1;
  const double elevation = draw.uniform(0.55, 0.95), azimuth = draw.uniform(-2.2, -0.9) + (number % 2 == 0 ? 1.6 : 0.0);
  day.to_sun = Eigen::Vector3d(std::cos(azimuth) * std::cos(elevation), std::sin(azimuth) * std::cos(elevation),
                               std::sin(elevation))
                   .cast<float>();
  day.clouds = static_cast<float>(fine ? 0.3 : draw.uniform(0.2, 0.9));
  const float clear = 1.0F - 0.8F * std::max(0.0F, day.clouds - 0.35F) / 0.65F;
  const float low = static_cast<float>(1.0 - 0.25 * (0.95 - elevation) / 0.4);  // a low sun is weaker and redder
  day.sun = Eigen::Vector3f(0.80F, 0.76F * (0.5F + 0.5F * low), 0.68F * low)
                .cwiseProduct(Eigen::Vector3f::Constant(clear * low));
  day.sky = Eigen::Vector3f(0.24F, 0.28F, 0.36F) + Eigen::Vector3f(0.1F, 0.07F, 0.0F) * day.clouds;
  day.wet = !fine && number % 3 == 0 ? static_cast<float>(draw.uniform(0.5, 1.0)) : 0.0F;
  day.leaves = !fine && number % 4 == 0 ? 0.12F : 1.0F;
  return day;
}

}  // namespace urban_nav_sim
