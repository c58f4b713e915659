// SPDX-License-Identifier: BSD-3-Clause
#include "ground_truth/cloud.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

namespace urban_nav_sim {
namespace {

using Eigen::Vector3f;

/// Straight along x at 1 m/s.
class Straight : public Motion {
 public:
  double duration() const override { return 10.0; }
  MotionState at(double t) const override {
    MotionState motion_state;
    motion_state.T_world_base = urban_nav_core::Pose(urban_nav_core::Quaterniond::Identity(), {t, 0.0, 0.0});
    return motion_state;
  }
};

/// Returns the largest distance of a point of a triangle from the nearest sample.
float largestHole(const Vector3f& a, const Vector3f& b, const Vector3f& c, float spacing) {
  std::vector<Vector3f> samples;
  sampleTriangle(a, b, c, spacing, [&](const Vector3f& w) {
    EXPECT_NEAR(w.sum(), 1.0F, 1e-5F);
    EXPECT_GE(w.minCoeff(), -1e-6F);
    samples.emplace_back(w[0] * a + w[1] * b + w[2] * c);
  });
  float worst = 0.0F;
  for (int i = 0; i <= 40; ++i)
    for (int j = 0; i + j <= 40; ++j) {
      const float u = static_cast<float>(i) / 40.0F, v = static_cast<float>(j) / 40.0F;
      const Vector3f p = (1.0F - u - v) * a + u * b + v * c;
      float nearest = 1e9F;
      for (const Vector3f& sample : samples) nearest = std::min(nearest, (sample - p).norm());
      worst = std::max(worst, nearest);
    }
  return worst;
}

TEST(Cloud, LeavesNoHolesInTriangles) {
  const float spacing = 0.05F, half_diagonal = spacing * 0.7072F;
  EXPECT_LT(largestHole({0, 0, 0}, {0.4F, 0, 0}, {0.1F, 0.3F, 0.2F}, spacing), half_diagonal);
  EXPECT_LT(largestHole({0, 0, 0}, {0.02F, 0, 0}, {0, 0.01F, 0}, spacing), half_diagonal);
  EXPECT_LT(largestHole({0, 0, 0}, {2.0F, 0.1F, 0}, {1.0F, 0, 0.02F}, spacing), half_diagonal);
  int count = 0;
  sampleTriangle({0, 0, 0}, {50.0F, 0, 0}, {25.0F, 0.04F, 0}, spacing, [&](const Vector3f&) { ++count; });
  EXPECT_LT(count, 2100) << "a sliver is not sampled as densely as a square";
}

TEST(Cloud, ContainsSurfacesNearThePath) {
  World world;
  world.materials.resize(2);
  world.materials[0].surface_class = SurfaceClass::Paved;
  world.materials[1].surface_class = SurfaceClass::TexturedWall;
  const auto rectangle = [](const Vector3f& corner, const Vector3f& u, const Vector3f& v, std::uint32_t material) {
    Part part;
    part.vertices = {corner, corner + u, corner + u + v, corner + v};
    part.texture.assign(4, Eigen::Vector2f::Zero());
    part.triangles = {{0, 1, 2}, {0, 2, 3}};
    part.material = material;
    return part;
  };
  world.parts = {rectangle({0, -1, 0}, {4, 0, 0}, {0, 2, 0}, 0), rectangle({0, 60, 0}, {4, 0, 0}, {0, 0, 3}, 1),
                 rectangle({2, 28, -2}, {1, 0, 0}, {0, 0, 3}, 1)};
  world.ground = [](double, double) { return 0.0; };
  const std::string path = ::testing::TempDir() + "cloud_test.ply";
  writeCloud(path, world, Straight());
  std::ifstream in(path, std::ios::binary);
  std::string line;
  std::size_t count = 0;
  while (std::getline(in, line) && line != "end_header")
    if (line.rfind("element vertex ", 0) == 0) count = std::stoul(line.substr(15));
  std::stringstream rest;
  rest << in.rdbuf();
  const std::string bytes = rest.str();
  ASSERT_EQ(bytes.size(), 13 * count);
  std::size_t ground = 0;
  for (std::size_t i = 0; i < count; ++i) {
    float p[3];
    std::memcpy(p, &bytes[13 * i], 12);
    const int surface_class = bytes[13 * i + 12];
    EXPECT_LT(p[1], 30.5F) << "the wall 60 m away is too far";
    EXPECT_GT(p[2], -0.31F) << "the foot of a wall below the ground is not visible";
    EXPECT_EQ(surface_class, p[1] > 20.0F ? 4 : 2);
    ground += surface_class == 2 ? 1 : 0;
  }
  EXPECT_GE(ground, 81U * 41U);
  EXPECT_LE(ground, 4000U);
  EXPECT_GE(count - ground, 21U * 21U);
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace urban_nav_sim
