// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "urban_nav_registration/cloud/cell_table.hpp"
#include "urban_nav_registration/cloud/surfels.hpp"

namespace urban_nav_registration {

/// Finds the nearest surfel within a fixed distance. Contains only surfels of planarity above 0; these are copied, so
/// that a look-up reads consecutive memory. Immutable, so thread-safe.
class SurfelIndex {
 public:
  /// `reach`: maximum distance of a surfel, m. `finer`: an index of the same surfels with a smaller reach, searched
  /// first, since most points have a near surfel.
  SurfelIndex(const std::vector<Surfel>& surfels, float reach, std::shared_ptr<const SurfelIndex> finer = nullptr);

  float reach() const { return reach_; }
  struct Nearest {
    const Surfel* surfel = nullptr;
    float margin = 0.0F;  ///< m by which the point may move, with the same normal, without a change of the nearest
                          ///< surfel within reach
  };
  /// Returns the nearest surfel within reach whose normal is within 45 deg of `normal`, irrespective of its sign; null
  /// if there is none. Among equally near ones, the first.
  Nearest nearest(const Eigen::Vector3f& point, const Eigen::Vector3f& normal) const;

 private:
  std::shared_ptr<const SurfelIndex> finer_;
  float reach_, per_m_;
  CellTable table_;
  std::vector<std::uint32_t> begins_;  // first index of each cell in sorted_, plus the end
  std::vector<Surfel> sorted_;
  std::array<std::vector<float>, 6> lanes_;  // x, y, z of the means, then of the normals, with padding at the end
};

}  // namespace urban_nav_registration
