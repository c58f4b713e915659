// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "urban_nav_core/trajectory/odometry_chain.hpp"
#include "urban_nav_core/types/closure.hpp"
#include "urban_nav_core/types/point_cloud.hpp"
#include "urban_nav_registration/retrieval/similar_places.hpp"

namespace loop_metric {

/// Proposes closures between places whose local clouds are similar, for a robot without cameras: the places that map
/// would compare (urban_nav_registration::CloudPlaces), in the order in which the robot passes them. Not thread-safe.
class CloudProposals {
 public:
  /// `voxel`: edge of the cells of surfels, m.
  explicit CloudProposals(double voxel) : voxel_(voxel) {}

  /// Place to be described by its cloud.
  struct Place {
    urban_nav_core::PoseRef at;  ///< session: as in candidates
    std::string part;            ///< gapless part of its session
    double distance = 0.0;       ///< m of path in it
    bool is_known = false;       ///< of an earlier session: found, but not compared with earlier places
  };

  /// Adds the places of odometry that has grown, once the path that describes them has been driven. `all`: up to its
  /// end. `at`: session of its places.
  void follow(const std::string& part, const urban_nav_core::PoseRef& at, const urban_nav_core::OdometryChain& odometry,
              bool is_known, bool all);
  /// Returns a place to be described, which is then no longer waiting; nullopt: none.
  std::optional<Place> next();
  /// Describes a place by its cloud within CloudPlaces::kHalfLength. Returns the closures with the most similar places
  /// before it (SimilarPlaceFinder).
  std::vector<urban_nav_core::TopologicalClosure> describe(const Place& place, const urban_nav_core::PointCloud& cloud);
  /// The running session has ended: its places belong to the session `id` from now on.
  void nameRunning(const std::string& id);

 private:
  struct Followed {
    std::size_t number = 0;  ///< of the part
    double next = 0.0;       ///< m, path to the next place
    std::size_t frame = 0;   ///< of the odometry, not looked at yet
  };
  const double voxel_;
  urban_nav_registration::SimilarPlaceFinder finder_;
  std::vector<urban_nav_core::PoseRef> described_;  // by their indices in finder_
  std::map<std::string, Followed> parts_;
  std::deque<Place> waiting_;
};

}  // namespace loop_metric
