// SPDX-License-Identifier: BSD-3-Clause
#include "features/cube_shape.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace scene_labeler {
namespace {

constexpr float kLeastPlanarity = 0.4F;  // least value of a surface with a normal
constexpr double kLeastCubes = 3.0;

}  // namespace

bool CubeShape::isPlane() const { return is_known && planarity > kLeastPlanarity; }

CubeShape shapeAround(const CubeLevel& level, std::size_t cube) {
  Moments all;
  forEachNeighbour(level, level.keys[cube], [&](std::uint32_t other) { all.add(level.cubes[other]); });
  CubeShape shape;
  shape.occupied = static_cast<float>(all.count / 27.0);
  shape.mean = all.mean().cast<float>();
  if (all.count < kLeastCubes) return shape;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
  eigen.computeDirect(all.covariance());
  const Eigen::Vector3d deviation = eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt();  // ascending
  const double longest = deviation[2];
  if (!(longest > 1e-6)) return shape;
  shape.is_known = true;
  shape.linearity = static_cast<float>((longest - deviation[1]) / longest);
  shape.planarity = static_cast<float>((deviation[1] - deviation[0]) / longest);
  shape.scatter = static_cast<float>(deviation[0] / longest);
  shape.normal = eigen.eigenvectors().col(0).cast<float>();
  shape.normal_z = std::abs(shape.normal.z());
  shape.tangent_z = static_cast<float>(std::abs(eigen.eigenvectors()(2, 2)));
  shape.roughness = static_cast<float>(deviation[0]);
  shape.vertical = static_cast<float>(std::sqrt(std::max(all.covariance()(2, 2), 0.0))) / level.edge;
  return shape;
}

void writeShape(const CubeShape& shape, const Eigen::Vector3f& point, float edge, float* out) {
  const Eigen::Vector3f offset = point - shape.mean;
  out[8] = shape.occupied;
  out[9] = offset.z() / edge;
  if (!shape.is_known) return;
  out[0] = shape.linearity;
  out[1] = shape.planarity;
  out[2] = shape.scatter;
  out[3] = shape.normal_z;
  out[4] = shape.tangent_z;
  out[5] = shape.roughness;
  out[6] = shape.vertical;
  out[7] = std::abs(shape.normal.dot(offset)) / edge;
}

}  // namespace scene_labeler
