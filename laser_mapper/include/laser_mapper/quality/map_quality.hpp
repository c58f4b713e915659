// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "laser_mapper/laser_map.hpp"
#include "laser_mapper/quality/plane_place.hpp"

namespace laser_mapper {

/// Statistics over all pairs of passes that measured one plane: rows of Table 4 of Newman et al. 2009. Zero without
/// places.
struct QualityFigures {
  struct Spread {
    double mean = 0.0;                            ///< over all pairs
    double least = 0.0, largest = 0.0;            ///< over the pairs
    double least_mean = 0.0, largest_mean = 0.0;  ///< over the means of the places
    double sigma = 0.0;                           ///< median over the places of the standard deviation of their means
                                                  ///< due to noise only
  };
  std::size_t places = 0, patches = 0, pairs = 0;
  Spread angle;         ///< rad
  Spread displacement;  ///< m
};
/// Returns the statistics of the union of places; sigma is the mean of both.
QualityFigures operator+(const QualityFigures& a, const QualityFigures& b);

/// Consistency of the passes of a map, measured without ground truth. Immutable, hence thread-safe.
class MapQuality {
 public:
  MapQuality() = default;
  /// Compares the passes of a rendered map. Throws DataError if the store is damaged.
  explicit MapQuality(const LaserMap& map);
  MapQuality(std::vector<PlanePlace> places, double voxel);

  const std::vector<PlanePlace>& places() const { return places_; }
  /// Return the statistics of the walls, as in the paper, and of level ground.
  QualityFigures walls() const;
  QualityFigures ground() const;
  /// Returns the mean displacement between passes at the place of a point, m; nullopt if there is no place.
  std::optional<float> displacementAt(const Eigen::Vector3f& p) const;
  /// Returns the places as a table with a header, one row per place.
  std::string printCsv() const;

 private:
  using Block = std::tuple<int, int, int>;
  Block blockAt(const Eigen::Vector3d& p) const;

  double radius_ = 1.0;  ///< m
  std::vector<PlanePlace> places_;
  std::map<Block, std::vector<std::size_t>> blocks_;  ///< places by position of their centres
};

}  // namespace laser_mapper
