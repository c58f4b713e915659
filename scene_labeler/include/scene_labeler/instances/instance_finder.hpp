// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "scene_labeler/instances/oriented_box.hpp"
#include "scene_labeler/labelling/map_labeler.hpp"
#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_registration/cloud/cell_table.hpp"

namespace scene_labeler {

/// Kind of a single object of a map.
enum class InstanceKind : std::uint8_t { Vehicle, Person, Pole };
constexpr std::size_t kInstanceKinds = 3;
const char* toString(InstanceKind kind);

/// Single object of a map.
struct Instance {
  InstanceKind kind = InstanceKind::Vehicle;
  OrientedBox box;                    ///< of the points, in the map
  double bottom = 0.0, height = 0.0;  ///< m: z of the ground, and of the highest point above it
  std::size_t points = 0;
  double probability = 0.0;                     ///< mean of the points' labels
  urban_nav_core::StampNs first = 0, last = 0;  ///< times of its points
};

/// Finds vehicles, people and poles in a labelled map. Vehicles are points of that class that are connected in plan
/// view. Parts that fit into one vehicle are joined, as of its two sides that were seen in different passes, unless
/// ground was seen between them. People and poles are connected points of the class `other` with the height and the
/// diameter of a person or a pole. Deterministic. Not thread-safe.
class InstanceFinder {
 public:
  /// Adds a point of the map, m. Points without a label are ignored. Only points of these classes and squares of the
  /// ground are kept.
  void add(const Eigen::Vector3f& point, const PointLabel& label, urban_nav_core::StampNs stamp);
  /// Returns the objects, by kind, then by place.
  std::vector<Instance> find() const;

 private:
  struct Candidate {
    Eigen::Vector3f p;
    std::uint8_t probability = 0;
    urban_nav_core::StampNs stamp = 0;
  };
  using Square = std::pair<int, int>;
  struct Ground {
    float sum = 0.0F;  // sum of z
    std::uint32_t count = 0;
  };
  using Cluster = std::vector<std::size_t>;  // indices of candidates

  static Square toSquare(double x, double y, double edge);
  /// Returns the ground in a square; null where none was seen.
  const Ground* findGround(const Square& square) const;
  /// Returns the height of the ground around a place; `otherwise` if none was seen within 3 m.
  double groundAt(const Eigen::Vector2d& place, double otherwise) const;
  std::vector<Cluster> connect(const std::vector<Candidate>& candidates, double link) const;
  static OrientedBox fitCluster(const std::vector<Candidate>& candidates, const Cluster& cluster);
  Instance describe(InstanceKind kind, const std::vector<Candidate>& candidates, const Cluster& cluster) const;
  bool areOneVehicle(const Cluster& a, const Cluster& b) const;
  bool isGroundBetween(const OrientedBox& a, const OrientedBox& b, const OrientedBox& joint) const;
  void findVehicles(std::vector<Instance>& found) const;
  void findSlender(std::vector<Instance>& found) const;

  std::vector<Candidate> vehicles_, others_;
  urban_nav_registration::CellTable ground_squares_{1024};
  std::vector<Ground> ground_;  // for each square
};

}  // namespace scene_labeler
