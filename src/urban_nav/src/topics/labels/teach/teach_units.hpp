// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "scene_labeler/scene.hpp"

namespace urban_nav {

/// Returns that one correction labels together: those of a superpixel at similar depth, or, of points that no image
/// shows, those of a cube of 0.4 m (scene_labeler::makePatches()). Units are numbered in the order of their first
/// points. Immutable after construction, hence thread-safe.
class TeachUnits {
 public:
  /// Number of points without a unit: not finite, or too far from the origin.
  static constexpr std::uint32_t kNone = 0xffffffffU;

  /// `superpixel`: edge of a superpixel, px.
  TeachUnits(const scene_labeler::Scene& scene, int superpixel);

  std::size_t size() const { return centres_.size(); }
  std::size_t points() const { return unit_of_.size(); }
  std::uint32_t unit(std::size_t point) const { return unit_of_[point]; }
  const std::vector<std::uint32_t>& unitNumbers() const { return unit_of_; }
  /// Returns the points of a unit, ascending.
  std::vector<std::uint32_t> members(std::uint32_t unit) const;
  std::size_t count(std::uint32_t unit) const { return first_[unit + 1] - first_[unit]; }
  /// Returns the mean of the points of a unit, m.
  const Eigen::Vector3f& centre(std::uint32_t unit) const { return centres_[unit]; }
  /// Returns the surface of a unit, m2: that of the cubes of 0.2 m with points, seen from one side.
  float area(std::uint32_t unit) const { return areas_[unit]; }
  /// Returns the point of a unit that is nearest to its centre.
  std::uint32_t middle(std::uint32_t unit) const { return middles_[unit]; }
  /// Returns the unit of a point and those with the centre within `radius`, m, of the point; ascending. Empty for a
  /// point without a unit.
  std::vector<std::uint32_t> near(std::uint32_t point, float radius) const;

 private:
  void group();
  void measure();

  std::vector<Eigen::Vector3f> places_;  // of the points, m
  std::vector<std::uint32_t> unit_of_;
  std::vector<std::uint32_t> first_, members_;  // of unit i: members_[first_[i]] to members_[first_[i + 1]]
  std::vector<Eigen::Vector3f> centres_;
  std::vector<float> areas_;
  std::vector<std::uint32_t> middles_;
};

}  // namespace urban_nav
