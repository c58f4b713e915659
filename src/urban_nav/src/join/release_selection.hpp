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

/// Part of a session kept in a release.
struct KeptSession {
  using Interval = std::pair<urban_nav_core::StampNs, urban_nav_core::StampNs>;

  urban_nav_store::SessionId id;
  std::set<urban_nav_core::StampNs> keyframes, places;
  std::vector<Interval> stretches;  ///< of scans and of the point map, in order of time, disjoint

  bool is_whole = false;  ///< all rows are kept, regardless of the other members

  bool isEmpty() const { return keyframes.empty() && places.empty() && stretches.empty(); }
};

/// Selects a part of a map that is sufficient for localization. Its size is bounded by the area of the map, not by the
/// number of sessions: keeps, per place and heading, views and panoramas of a few sessions with different features, and
/// the scans of the first passes that cover the area.
///
/// Sessions are added one after another, without effect on the previous selection. Not thread-safe.
class ReleaseSelection {
 public:
  /// `cloud_half_length`: half length of the clouds for localization, m along the path.
  explicit ReleaseSelection(double cloud_half_length) : cloud_half_length_(cloud_half_length) {}

  /// Selects from a session, whose rows are in `store`.
  KeptSession add(urban_nav_store::Store& store, const urban_nav_store::StoredTrajectory& session);
  /// Keeps a session of a release unchanged.
  KeptSession addWhole(urban_nav_store::Store& store, const urban_nav_store::StoredTrajectory& session);

 private:
  struct View {
    std::size_t session = 0;
    urban_nav_core::Pose T_map_base;
    std::string features;  ///< packed descriptors; empty: unknown
  };
  /// Limits within which two views have the same place and heading.
  struct Nearness {
    double distance, angle;  ///< m, rad
    double own_distance;     ///< m; between views of the same session
  };
  /// Kept views, by grid cells of the ground.
  class Views {
   public:
    /// Keeps a view if it adds new features; returns whether it was kept.
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

/// Returns a filter of the rows of a store that a release of these sessions has.
urban_nav_store::RowFilter releaseRows(const std::vector<KeptSession>& sessions,
                                       const urban_nav_store::SessionId& first);

}  // namespace urban_nav
