// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "urban_nav_store/merge.hpp"
#include "urban_nav_store/stored_map.hpp"

namespace urban_nav {

/// Part of a session that a release keeps.
struct KeptSession {
  using Interval = std::pair<urban_nav_core::StampNs, urban_nav_core::StampNs>;

  urban_nav_store::SessionId id;
  std::set<urban_nav_core::StampNs> keyframes, places;
  std::vector<Interval> stretches;  ///< of scans and of the map of points, in order of time; they do not overlap

  bool is_whole = false;  ///< all rows are kept, whatever is above

  bool isEmpty() const { return keyframes.empty() && places.empty() && stretches.empty(); }
};

/// Selects what of a map localizes as well as all of it. The result is bounded by the area of the map, not by the
/// number of its sessions: of one place and heading it keeps the views of a few sessions whose features differ, of the
/// panoramas of a place in the same manner, and of the scans those of the first passes that cover the area.
///
/// Sessions are offered one after another; what was kept before stays. Not thread-safe.
class ReleaseSelection {
 public:
  /// `cloud_half_length`: of the clouds that localization aligns, m along the path.
  explicit ReleaseSelection(double cloud_half_length) : cloud_half_length_(cloud_half_length) {}

  /// Selects from a session, whose rows are in `store`.
  KeptSession add(urban_nav_store::Store& store, const urban_nav_store::StoredTrajectory& session);
  /// Keeps a session of a release as it is.
  KeptSession addWhole(urban_nav_store::Store& store, const urban_nav_store::StoredTrajectory& session);

 private:
  struct View {
    std::size_t session = 0;
    urban_nav_core::Pose T_map_base;
    std::string features;  ///< packed descriptors; empty: unknown
  };
  /// Limits within which two views are of one place and heading.
  struct Nearness {
    double distance, angle;  ///< m, rad
    double own_distance;     ///< m; of the same session, which moves on between its views
  };
  /// The views that were kept, by cells of the ground.
  class Views {
   public:
    /// Returns whether a view adds something, and keeps it if so.
    bool add(const View& view, const Nearness& nearness);
    void keep(const View& view);

   private:
    std::map<std::pair<int, int>, std::vector<View>> cells_;
  };

  KeptSession select(urban_nav_store::Store& store, const urban_nav_store::StoredTrajectory& session, bool is_whole);
  void selectViews(urban_nav_store::Store& store, const urban_nav_store::StoredTrajectory& session, KeptSession& kept);
  void selectStretches(urban_nav_store::Store& store, const urban_nav_store::StoredTrajectory& session,
                       KeptSession& kept);

  const double cloud_half_length_;
  std::size_t sessions_ = 0;
  Views keyframes_, places_;
  std::map<std::pair<int, int>, std::vector<urban_nav_core::Vector3d>> clouds_;  // centres, by cells
};

/// Returns the rows of a store that a release with these sessions holds.
urban_nav_store::RowFilter releaseRows(const std::vector<KeptSession>& sessions,
                                       const urban_nav_store::SessionId& first);

}  // namespace urban_nav
