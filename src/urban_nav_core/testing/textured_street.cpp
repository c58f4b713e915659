// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/testing/textured_street.hpp"

#include <array>
#include <cmath>
#include <random>

namespace urban_nav_core::testing {
namespace {

using TexturePointer = std::shared_ptr<const Texture>;

TexturePointer brickHouse(double base, std::uint32_t seed) {
  return std::make_shared<Texture>(base, std::vector<Octave>{{2.3, 10.0, false}, {0.4, 7.0, true}, {0.09, 11.0, true}},
                                   std::vector<Cells>{{0.26, 0.09, 0.5, 0.006, 0.006, 1.0, -30.0, 10.0, 1},
                                                      {2.3, 3.0, 0.0, 0.55, 0.75, 0.9, -85.0, -35.0, 2},
                                                      {0.575, 0.75, 0.0, 0.05, 0.06, 0.5, -15.0, 35.0, 3}},
                                   seed);
}

TexturePointer plasterHouse(double base, std::uint32_t seed) {
  return std::make_shared<Texture>(base, std::vector<Octave>{{2.9, 14.0, false}, {0.35, 8.0, true}, {0.08, 12.0, true}},
                                   std::vector<Cells>{{1.9, 2.8, 0.0, 0.45, 0.6, 0.85, -90.0, -30.0, 4},
                                                      {3.8, 2.8, 0.0, 0.02, 1.3, 1.0, 15.0, 40.0, 5},
                                                      {0.33, 0.41, 0.4, 0.04, 0.05, 0.25, -30.0, 30.0, 6}},
                                   seed);
}

TexturePointer asphalt(std::uint32_t seed) {
  return std::make_shared<Texture>(95.0, std::vector<Octave>{{3.0, 10.0, false}, {0.4, 9.0, true}, {0.07, 14.0, true}},
                                   std::vector<Cells>{{4.0, 3.1, 0.3, 0.6, 0.5, 0.4, -25.0, 15.0, 7},
                                                      {0.8, 0.7, 0.5, 0.12, 0.2, 0.15, -40.0, 25.0, 8}},
                                   seed);
}

TexturePointer pavement(std::uint32_t seed) {
  return std::make_shared<Texture>(150.0, std::vector<Octave>{{2.0, 9.0, false}, {0.25, 8.0, true}, {0.05, 11.0, true}},
                                   std::vector<Cells>{{0.6, 0.6, 0.5, 0.012, 0.012, 1.0, -35.0, 5.0, 9}}, seed);
}

TexturePointer bodywork(double base, std::uint32_t seed) {
  return std::make_shared<Texture>(base, std::vector<Octave>{{0.8, 12.0, false}, {0.12, 9.0, true}},
                                   std::vector<Cells>{{1.05, 0.75, 0.0, 0.12, 0.14, 0.8, -70.0, 20.0, 10},
                                                      {0.35, 0.25, 0.5, 0.06, 0.06, 0.4, -50.0, 60.0, 11}},
                                   seed);
}

Rectangle ground(double x0, double x1, double y0, double y1, double z, TexturePointer texture) {
  return {{x0, y0, z}, Vector3d::UnitX(), Vector3d::UnitY(), x1 - x0, y1 - y0, std::move(texture), 0.0, y0, 1.0};
}

}  // namespace

Scene texturedStreet(const StreetSize& size, std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto between = [&random](double low, double high) {
    return low + (high - low) * (static_cast<double>(random()) / 4294967296.0);
  };
  const std::uint32_t s = 1000U * seed;
  const std::array<TexturePointer, 4> houses{brickHouse(170.0, s + 1), plasterHouse(160.0, s + 2),
                                             brickHouse(140.0, s + 3), plasterHouse(185.0, s + 4)};
  const std::array<TexturePointer, 3> cars{bodywork(70.0, s + 5), bodywork(130.0, s + 6), bodywork(190.0, s + 7)};
  const double half = 0.5 * size.width, kerb = half - 2.6, begin = -15.0;
  Scene street;
  street.rectangles = {ground(begin, size.length, -kerb, kerb, 0.0, asphalt(s + 8)),
                       ground(begin, size.length, kerb, half + 4.0, 0.0, pavement(s + 9)),
                       ground(begin, size.length, -half - 4.0, -kerb, 0.0, pavement(s + 10))};
  for (const double side : {1.0, -1.0}) {
    std::size_t which = side > 0.0 ? 0 : 1;
    for (double x = begin; x < size.length;) {
      const double width = between(7.0, 15.0), depth = 8.0, set_back = between(0.0, 1.2);
      const Pose T_world_house(Quaterniond::Identity(),
                               Vector3d(x + 0.5 * width, side * (half + set_back + 0.5 * depth), 0.0));
      street.addBox(T_world_house, {width, depth, between(6.0, 11.0)}, houses[which % houses.size()],
                    between(0.0, 20.0));
      which += 1 + static_cast<std::size_t>(between(0.0, 2.0));
      x += width + (between(0.0, 1.0) < 0.25 ? 2.5 : 0.0);
    }
    for (double x = begin + between(0.0, 8.0); x < size.length;) {
      const Pose T_world_car(expSo3(Vector3d(0.0, 0.0, between(-0.03, 0.03))), Vector3d(x, side * (kerb - 1.15), 0.0));
      street.addBox(T_world_car, {between(3.8, 4.8), 1.75, between(1.35, 1.9)}, cars[random() % cars.size()],
                    between(0.0, 9.0));
      x += between(6.0, 17.0);
    }
  }
  return street;
}

std::function<Scene(double)> streetWithVan(const StreetSize& size, double speed, double ahead, std::uint32_t seed) {
  const Scene street = texturedStreet(size, seed);
  const TexturePointer texture = bodywork(150.0, 1000U * seed + 11);
  return [=](double t) {
    Scene scene = street;
    const double x = speed * t + ahead * (1.0 + 0.2 * std::sin(0.5 * t));
    scene.addBox(Pose(Quaterniond::Identity(), Vector3d(x + 2.5, 0.3, 0.0)), {5.0, 2.0, 2.3}, texture, 4.0);
    return scene;
  };
}

}  // namespace urban_nav_core::testing
