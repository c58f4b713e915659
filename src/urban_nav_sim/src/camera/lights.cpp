// SPDX-License-Identifier: BSD-3-Clause
#include "camera/lights.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "noise/hash.hpp"

namespace urban_nav_sim {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr float kReach = 28.0F;     // m: a lamp would give 3 lx there, and fades to none
constexpr float kLampCell = 14.0F;  // m
constexpr float kLeast = 1e-7F;     // 0.01 lx
constexpr float kGlass = 0.33F;     // m, radius of a lantern
/// Radiance of a lantern per intensity: 0.1 m^2 of glass.
constexpr float kLanternArea = 0.1F;
constexpr float kWeakestLamp = 0.04F;  // of the strongest lamp at a point: weaker ones are left out
/// Light that streets and walls scatter: 0.2 of the flux of a lantern on some 600 m^2 of a street, 3 lx of 2500 cd.
constexpr float kScattered = 0.12F, kScatterRange2 = 90.0F;
/// Radiance of a lit room seen from outside: 150 lx, walls of albedo 0.5, so 25 of 30 000 cd/m^2.
constexpr float kRoom = 8e-4F;

std::uint64_t toKey(const Vector3f& corner) {
  std::array<std::uint32_t, 3> bits;
  std::memcpy(bits.data(), corner.data(), sizeof(bits));
  return hash(bits[0], bits[1], bits[2]);
}

/// Returns the share of the intensity in a direction: full below, none above, as by a lantern with a reflector.
float shine(float down) {
  const float t = std::clamp((down + 0.1F) / 0.5F, 0.0F, 1.0F);
  return 0.03F + 0.97F * t * t * (3.0F - 2.0F * t);
}

float fadeOut(float metres) {
  const float part = metres / kReach, rest = std::max(0.0F, 1.0F - part * part * part * part);
  return rest * rest;
}

/// Returns the rooms with light in a day's night or dusk.
std::unordered_map<std::uint64_t, Vector3f> drawRooms(const World& world) {
  std::unordered_map<std::uint64_t, Vector3f> rooms;
  const bool late = world.day.light == Light::Night;
  for (const Window& window : world.windows) {
    Draw house(hash(window.house, 0x40E, static_cast<std::uint64_t>(world.day.number)));
    const double share = house.uniform(0.1, 0.6) * (late ? 1.0 : 0.6);
    Draw room(hash(toKey(window.corner), static_cast<std::uint64_t>(world.day.number)));
    const double drawn = room.uniform();  // so that a room lit at dusk is lit at night
    if (drawn >= share) continue;
    const float level = kRoom * static_cast<float>(std::exp(0.5 * room.normal()));
    const auto warm = static_cast<float>(room.uniform());  // from a neutral to a warm bulb
    rooms[toKey(window.corner)] = level * Vector3f(1.15F + 0.25F * warm, 1.0F, 0.75F - 0.35F * warm);
  }
  return rooms;
}

}  // namespace

Lights::Lights(const World& world) {
  if (world.day.light == Light::Day) return;
  rooms_ = drawRooms(world);
  if (world.day.light != Light::Night || world.lamps.empty()) return;
  lamps_ = world.lamps;
  Vector2f low = lamps_[0].position.head<2>(), high = low;
  for (const Lamp& lamp : lamps_) {
    low = low.cwiseMin(lamp.position.head<2>());
    high = high.cwiseMax(lamp.position.head<2>());
  }
  origin_ = low - Vector2f::Constant(kReach);
  const Vector2f size = high - low + Vector2f::Constant(2.0F * kReach);
  columns_ = 1 + static_cast<int>(size.x() / kLampCell);
  rows_ = 1 + static_cast<int>(size.y() / kLampCell);
  cells_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const Vector2f corner = origin_ + kLampCell * Vector2f(static_cast<float>(column), static_cast<float>(row));
      for (std::uint32_t i = 0; i < lamps_.size(); ++i) {
        const Vector2f at = lamps_[i].position.head<2>();
        const Vector2f nearest = at.cwiseMax(corner).cwiseMin(corner + Vector2f::Constant(kLampCell));
        if ((at - nearest).norm() < kReach) cells_[static_cast<std::size_t>(row * columns_ + column)].push_back(i);
      }
    }
  }
}

const std::vector<std::uint32_t>& Lights::lampsNear(const Vector3f& position) const {
  static const std::vector<std::uint32_t> none;
  const Vector2f cell = (position.head<2>() - origin_) / kLampCell;
  if (!(cell.minCoeff() >= 0.0F)) return none;
  const int column = static_cast<int>(cell.x()), row = static_cast<int>(cell.y());
  if (column >= columns_ || row >= rows_) return none;
  return cells_[static_cast<std::size_t>(row * columns_ + column)];
}

Lights::Sources Lights::sourcesAt(const SurfacePoint& point) const {
  Sources found;
  for (const std::uint32_t i : lampsNear(point.position)) {
    const Lamp& lamp = lamps_[i];
    const Vector3f to_lamp = lamp.position - point.position;
    const float distance2 = std::max(to_lamp.squaredNorm(), 0.04F), distance = std::sqrt(distance2);
    if (distance >= kReach) continue;
    const float fades = fadeOut(distance), cosine = point.normal.dot(to_lamp) / distance;
    found.scattered += kScattered * fades / (kScatterRange2 + distance2) * lamp.intensity;
    const float facing = point.surface_class == SurfaceClass::Foliage ? 0.3F + 0.45F * std::abs(cosine) : cosine;
    if (facing <= 0.0F) continue;
    Source source{i, to_lamp, facing * fades * shine(to_lamp.z() / distance) / distance2 * lamp.intensity};
    if (source.radiance.y() < kLeast) continue;
    // Inserts it in order; of equal ones that with the lower index is first.
    int place = std::min(found.count, kMostSources);
    while (place > 0 && found.all[static_cast<std::size_t>(place - 1)].radiance.y() < source.radiance.y()) --place;
    if (place == kMostSources) continue;
    found.count = std::min(found.count + 1, kMostSources);
    for (int k = found.count - 1; k > place; --k)
      found.all[static_cast<std::size_t>(k)] = found.all[static_cast<std::size_t>(k - 1)];
    found.all[static_cast<std::size_t>(place)] = source;
  }
  while (found.count > 1 &&
         found.all[static_cast<std::size_t>(found.count - 1)].radiance.y() < kWeakestLamp * found.all[0].radiance.y())
    --found.count;
  return found;
}

Vector3f Lights::own(const SurfacePoint& point, const Appearance& surface) const {
  Vector3f light = Vector3f::Zero();
  if (surface.glass > 0.0F) {
    if (const auto room = rooms_.find(toKey(point.corner)); room != rooms_.end()) {
      // Textures of windows run from (0, 0) to (2, 2): the lamp is high in the room, curtains are at the sides.
      const float aside = std::clamp((std::abs(point.spot.at.x() - 1.0F) - 0.55F) / 0.15F, 0.0F, 1.0F);
      const float above = std::clamp(0.5F * point.spot.at.y(), 0.0F, 1.0F);
      light += surface.glass * (1.0F - 0.5F * aside) * (0.7F + 0.5F * above) * room->second;
    }
  }
  if (!lamps_.empty()) {
    for (const std::uint32_t i : lampsNear(point.position))
      if ((lamps_[i].position - point.position).squaredNorm() < kGlass * kGlass)
        light += lamps_[i].intensity / kLanternArea;
  }
  return light;
}

}  // namespace urban_nav_sim
