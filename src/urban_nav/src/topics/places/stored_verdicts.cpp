// SPDX-License-Identifier: BSD-3-Clause
#include "topics/places/stored_verdicts.hpp"

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/place_link.hpp"
#include "urban_nav_store/tables/stored_place.hpp"

namespace urban_nav {

using fabmap_node::PlaceVerdict;
using urban_nav_core::ClosureVerdict;
using urban_nav_core::StampNs;
using urban_nav_store::Edge;
using urban_nav_store::EdgeKind;
using urban_nav_store::PlaceLink;
using urban_nav_store::StoredPlace;
using urban_nav_store::TableStore;

namespace {

constexpr StampNs kOneObservation = 500'000'000;  // ns: edges are at the nearest frame of odometry

/// Returns the verdict that an edge records; nullopt for edges of odometry, and for candidates without data.
std::optional<PlaceVerdict> verdictOfEdge(const Edge& edge) {
  if (edge.kind != EdgeKind::Stereo && edge.kind != EdgeKind::Icp) return std::nullopt;
  if (edge.verdict == ClosureVerdict::Accepted) return PlaceVerdict::Confirmed;
  if (edge.verdict == ClosureVerdict::Waiting) return PlaceVerdict::Accepted;
  if (!edge.measured.information.isZero(0.0)) return PlaceVerdict::Withdrawn;
  urban_nav_core::MetricClosure closure;
  closure.verdict = ClosureVerdict::Rejected;
  closure.reason_name = edge.reason.substr(0, edge.reason.find(':'));
  return fabmap_node::placeVerdict(closure);
}

PlaceVerdict verdictOfLink(const PlaceLink& link) {
  if (link.accepted == 0) return PlaceVerdict::Withdrawn;
  return link.revision > 0 ? PlaceVerdict::Confirmed : PlaceVerdict::Accepted;
}

/// Verdicts at the stamps of later poses, of one session.
using VerdictsAt = std::map<StampNs, PlaceVerdict>;

void addVerdict(VerdictsAt& verdicts, StampNs stamp, PlaceVerdict verdict) {
  const auto [known, is_new] = verdicts.try_emplace(stamp, verdict);
  if (!is_new && fabmap_node::logRatio(verdict) > fabmap_node::logRatio(known->second)) known->second = verdict;
}

/// `stamps`: in ascending order.
std::optional<StampNs> nearestStamp(const std::vector<StampNs>& stamps, StampNs stamp) {
  const auto after = std::lower_bound(stamps.begin(), stamps.end(), stamp);
  std::optional<StampNs> nearest;
  if (after != stamps.end()) nearest = *after;
  if (after != stamps.begin() && (!nearest || stamp - *std::prev(after) <= *nearest - stamp))
    nearest = *std::prev(after);
  if (nearest && std::abs(*nearest - stamp) > kOneObservation) nearest.reset();
  return nearest;
}

/// Returns the verdicts moved to the nearest observations.
VerdictsAt atObservations(const VerdictsAt& verdicts, const std::vector<StampNs>& observations) {
  VerdictsAt moved;
  for (const auto& [stamp, verdict] : verdicts)
    if (const auto observation = nearestStamp(observations, stamp)) addVerdict(moved, *observation, verdict);
  return moved;
}

}  // namespace

StoredVerdicts::StoredVerdicts(urban_nav_store::Store& store) {
  std::map<urban_nav_store::SessionId, VerdictsAt> of_edges, of_links;
  const std::vector<urban_nav_store::Session> sessions = store.sessions().all();
  for (const urban_nav_store::Session& session : sessions) {
    store.graph().forEachEdge(session.id, [&](const Edge& edge) {
      if (const auto verdict = verdictOfEdge(edge)) addVerdict(of_edges[edge.b.session], edge.b.stamp, *verdict);
    });
    TableStore<PlaceLink>(store).forEach(session.id, [&](const PlaceLink& link) {
      addVerdict(of_links[link.session], link.stamp, verdictOfLink(link));
    });
  }
  for (const urban_nav_store::Session& session : sessions) {
    std::vector<StampNs> observations;
    TableStore<StoredPlace>(store).forEach(session.id,
                                           [&](const StoredPlace& row) { observations.push_back(row.stamp); });
    VerdictsAt verdicts = atObservations(of_edges[session.id], observations);
    verdicts.merge(atObservations(of_links[session.id], observations));  // those without an edge
    for (const auto& [stamp, verdict] : verdicts) words_[{session.id, stamp}] = fabmap_node::toString(verdict);
  }
}

const std::string& StoredVerdicts::find(const urban_nav_store::SessionId& session, StampNs stamp) const {
  static const std::string kNoVerdict;
  const auto found = words_.find({session, stamp});
  return found == words_.end() ? kNoVerdict : found->second;
}

}  // namespace urban_nav
