// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "features/cube_moments.hpp"
#include "features/cube_shape.hpp"
#include "features/ground_height.hpp"
#include "scene_labeler/features/features.hpp"

namespace scene_labeler {

/// Cloud around a robot that grows sweep by sweep. Its cubes are updated by each point, so that the features of a few
/// points cost the same for any size of the cloud. Not thread-safe.
class GrowingCloud {
 public:
  /// Adds points, m. Points that are not finite, or more than 100 km from the first one, are ignored; a cube of 0.1 m
  /// uses its first four points.
  void add(const std::vector<Eigen::Vector3f>& points);
  /// Returns the features of points of the cloud, as measureFeatures() of all points without reflectance and image.
  /// Each cube is in the column of its middle, and heights refer to all past means of the cubes of a column. All
  /// features of points that were ignored are missing.
  FeatureTable measure(const std::vector<Eigen::Vector3f>& points, FeatureSet set) const;
  /// Removes cubes of 1.6 m further than `reach`, m, from a place, in plan view.
  void keepAround(const Eigen::Vector3f& place, float reach);

  /// Distinct ones of the numbers of points, and for each point the index of its number.
  struct Distinct {
    std::vector<std::uint32_t> numbers, index_of;
  };

  /// Returns the number of cubes of 0.1 m.
  std::size_t size() const { return levels_[0].cubes.size(); }

 private:
  void addPoint(const Eigen::Vector3f& point);
  /// Adds `change` to the sums of a cube and of the coarser cubes around it.
  void update(std::size_t level, std::uint64_t key, const Moments& change);
  std::uint32_t findOrInsert(std::size_t level, std::uint64_t key);
  void measureLevel(std::size_t level, const std::vector<Eigen::Vector3f>& points, FeatureSet set, std::size_t first,
                    FeatureTable& table) const;
  void measureCloud(const std::vector<Eigen::Vector3f>& points, FeatureTable& table) const;
  Distinct distinctCubes(std::size_t level, const std::vector<Eigen::Vector3f>& points) const;
  std::vector<CubeShape> measureShapes(std::size_t level, const std::vector<std::uint32_t>& cubes) const;
  /// Returns the heights of points; zeros outside the cloud.
  std::vector<ColumnHeights> measureHeights(const std::vector<Eigen::Vector3f>& points) const;
  void measureColumns(const std::vector<Eigen::Vector3f>& points, FeatureSet set, std::size_t first,
                      FeatureTable& table) const;
  /// Returns the cube of a point at a level; kNone outside the cloud.
  std::uint32_t findCube(std::size_t level, const Eigen::Vector3f& point) const;

  std::optional<Eigen::Vector3f> origin_;
  CubeLevels levels_;                                     // normalised, as makeCubeLevels()
  std::array<std::vector<Moments>, kCubeLevels> sums_{};  // before normalisation
  ColumnGrid columns_;
  std::vector<std::uint32_t> column_of_;  // for each cube of the height level
};

}  // namespace scene_labeler
