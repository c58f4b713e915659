// SPDX-License-Identifier: BSD-3-Clause
#include "world/day.hpp"

#include <cmath>

#include "noise/hash.hpp"

namespace urban_nav_sim {

namespace {

using Eigen::Vector3f;

constexpr double kDuskElevation = 3.0 * M_PI / 180.0;
/// Share of the sunlight left 3 deg above the horizon: air mass 15.2 (Kasten and Young 1989), optical depths 0.15, 0.23
/// and 0.35 for red, green and blue (Rayleigh scattering, ozone, the haze of a town).
const Vector3f kDuskSun(0.100F, 0.033F, 0.005F);
/// 700 lx, a quarter of a clear sky's with the sun that low: walls and roofs hide most of it from a street, which the
/// renderer leaves out.
const Vector3f kDuskSky(0.0062F, 0.0070F, 0.0092F);
/// 0.15 lx: the glow above a town.
const Vector3f kNightSky(1.7e-6F, 1.5e-6F, 1.2e-6F);
constexpr float kOfTheGround = 0.1F;  ///< light from the ground by light upon it, as in the defaults of Day

void dim(Day& day, std::uint32_t seed, float clear) {
  if (day.light == Light::Dusk) {
    // The sun sets in one place of the horizon, which moves with the season.
    Draw place(hash(seed, 0xD05C)), season(hash(seed, 0xD05D, static_cast<std::uint64_t>(day.number)));
    const double azimuth = place.uniform(-M_PI, M_PI) + season.uniform(-0.4, 0.4);
    day.to_sun = Eigen::Vector3d(std::cos(azimuth) * std::cos(kDuskElevation),
                                 std::sin(azimuth) * std::cos(kDuskElevation), std::sin(kDuskElevation))
                     .cast<float>();
    day.sun = clear * kDuskSun;
    day.sky = (1.0F - 0.3F * day.clouds) * kDuskSky;
  } else {
    day.sun.setZero();
    day.sky = (1.0F + day.clouds) * kNightSky;  // clouds reflect the light of the town
  }
  day.ground = kOfTheGround * (day.to_sun.z() * day.sun + day.sky);
}

}  // namespace

Day makeDay(std::uint32_t seed, int number, Light light) {
  Draw draw(hash(seed, 0xDA1, static_cast<std::uint64_t>(number)));
  Day day;
  day.number = number;
  day.light = light;
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
  if (light != Light::Day) dim(day, seed, clear);
  return day;
}

}  // namespace urban_nav_sim
