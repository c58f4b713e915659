// SPDX-License-Identifier: BSD-3-Clause
#include "map/learnt_links.hpp"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "map/map_division.hpp"
#include "urban_nav_store/table_store.hpp"

namespace urban_nav {

using urban_nav_core::ClosureMethod;
using urban_nav_core::ClosureVerdict;
using urban_nav_core::MetricClosure;
using urban_nav_core::StampNs;
using urban_nav_store::PlaceLink;
using urban_nav_store::SessionId;
using urban_nav_store::TableStore;

namespace {

template <typename Name>
std::optional<std::size_t> findNumber(const std::vector<Name>& names, const Name& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<std::size_t>(found - names.begin());
}

bool isSamePair(const PlaceLink& a, const PlaceLink& b) {
  return std::tie(a.session, a.stamp, a.earlier, a.earlier_stamp) ==
         std::tie(b.session, b.stamp, b.earlier, b.earlier_stamp);
}

/// Returns whether a session of the group is recognised with what the link confirms. `order`: ids of the sessions of a
/// group as they are recognised.
bool isFollowed(const PlaceLink& link, const std::vector<SessionId>& order) {
  const auto later = findNumber(order, link.session), earlier = findNumber(order, link.earlier);
  return later && earlier && *earlier <= *later && *later + 1 < order.size();
}

std::vector<PlaceLink> followedLinks(const MapContext& context, const std::vector<PlaceLink>& links) {
  const std::vector<SessionId> ids = context.ids();
  std::vector<std::vector<SessionId>> orders;
  for (const std::vector<std::size_t>& group : sessionsOfGroups(context)) {
    orders.emplace_back();
    for (const std::size_t s : recognitionOrder(context, group)) orders.back().push_back(ids[s]);
  }
  std::vector<PlaceLink> followed;
  for (const PlaceLink& link : links)
    if (link.accepted != 0 && std::any_of(orders.begin(), orders.end(),
                                          [&](const std::vector<SessionId>& order) { return isFollowed(link, order); }))
      followed.push_back(link);
  return followed;
}

}  // namespace

std::vector<PlaceLink> linksOfGraph(const MapContext& context, const std::vector<MetricClosure>& closures,
                                    const std::vector<ClosureAssessment>& assessments) {
  const std::vector<SessionId> ids = context.ids();
  std::map<std::tuple<std::size_t, StampNs, std::size_t, StampNs>, PlaceLink> links;
  for (std::size_t i = 0; i < std::min(closures.size(), assessments.size()); ++i) {
    const MetricClosure& closure = closures[i];
    const auto a = findNumber(context.names, closure.a.session), b = findNumber(context.names, closure.b.session);
    if (!a || !b || closure.method == ClosureMethod::None || closure.verdict != ClosureVerdict::Accepted ||
        !isMeasured(closure) || assessments[i].id == 0 || assessments[i].verdict == ClosureVerdict::Waiting)
      continue;
    PlaceLink link{ids[*b], closure.b.stamp, ids[*a], closure.a.stamp};
    link.metres = closure.measured.T_a_b.t().norm();
    link.same_direction = closure.measured.T_a_b.R()(0, 0) > 0.0 ? 1 : 0;
    link.accepted = assessments[i].verdict == ClosureVerdict::Accepted ? 1 : 0;
    link.revision = 1;
    const auto [known, is_new] = links.try_emplace({*b, link.stamp, *a, link.earlier_stamp}, link);
    if (!is_new && known->second.accepted == 0) known->second = link;
  }
  std::vector<PlaceLink> sorted;
  for (auto& [place, link] : links) sorted.push_back(std::move(link));
  return sorted;
}

std::optional<std::vector<PlaceLink>> linksToLearn(const MapContext& context, const std::vector<PlaceLink>& links) {
  if (!context.divides) return std::nullopt;
  if (!context.learnt) {
    std::vector<PlaceLink> followed = followedLinks(context, links);
    if (followed.empty()) return std::nullopt;
    return followed;
  }
  std::vector<PlaceLink> kept;
  for (const PlaceLink& link : *context.learnt)
    if (std::none_of(links.begin(), links.end(),
                     [&](const PlaceLink& now) { return now.accepted == 0 && isSamePair(now, link); }))
      kept.push_back(link);
  if (kept.size() == context.learnt->size()) return std::nullopt;
  return kept;
}

void storeLinks(urban_nav_store::Store& store, const std::vector<PlaceLink>& links) {
  TableStore<PlaceLink> table(store);
  for (const PlaceLink& link : links)
    if (link.accepted != 0 || table.get(link)) table.put(link);
}

std::vector<PlaceLink> knownLinks(const MapContext& context) {
  std::vector<PlaceLink> links = context.learnt.value_or(std::vector<PlaceLink>());
  const std::vector<SessionId> ids = context.ids();
  for (std::size_t s = 0; s < ids.size(); ++s) {
    if (!hasKnownPlaces(context, s)) continue;
    TableStore<PlaceLink>(*context.store).forEach(ids[s], [&](const PlaceLink& link) {
      if (link.accepted != 0) links.push_back(link);
    });
  }
  return links;
}

}  // namespace urban_nav
