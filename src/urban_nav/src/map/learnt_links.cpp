// SPDX-License-Identifier: BSD-3-Clause
#include "map/learnt_links.hpp"

#include <algorithm>
#include <optional>

#include "map/map_division.hpp"
#include "urban_nav_store/table_store.hpp"

namespace urban_nav {

using urban_nav_core::ClosureMethod;
using urban_nav_core::ClosureVerdict;
using urban_nav_core::MetricClosure;
using urban_nav_store::PlaceLink;
using urban_nav_store::TableStore;

namespace {

constexpr std::size_t kSessionsToLearn = 3;  // two that are confirmed, and one that asks

std::optional<std::size_t> findNumber(const MapContext& context, const std::string& name) {
  const auto found = std::find(context.names.begin(), context.names.end(), name);
  if (found == context.names.end()) return std::nullopt;
  return static_cast<std::size_t>(found - context.names.begin());
}

}  // namespace

std::vector<PlaceLink> acceptedLinks(urban_nav_store::Store& store, const MapContext& context,
                                     const std::vector<MetricClosure>& closures,
                                     const std::vector<ClosureAssessment>& assessments) {
  const std::vector<urban_nav_store::SessionId> ids = context.ids();
  const TableStore<PlaceLink> stored(store);
  std::vector<PlaceLink> links;
  for (std::size_t i = 0; i < std::min(closures.size(), assessments.size()); ++i) {
    const MetricClosure& closure = closures[i];
    const auto a = findNumber(context, closure.a.session), b = findNumber(context, closure.b.session);
    if (!a || !b || closure.method == ClosureMethod::None || assessments[i].id == 0) continue;
    PlaceLink link{ids[*b], closure.b.stamp, ids[*a], closure.a.stamp};
    link.metres = closure.measured.T_a_b.t().norm();
    link.same_direction = closure.measured.T_a_b.R()(0, 0) > 0.0 ? 1 : 0;
    link.accepted = assessments[i].verdict == ClosureVerdict::Accepted ? 1 : 0;
    link.revision = 1;
    const bool is_measured = isMeasured(closure) && closure.verdict == ClosureVerdict::Accepted;
    if (is_measured && link.accepted != 0) links.push_back(link);
    else if (link.accepted == 0 && stored.get(link)) links.push_back(link);
  }
  return links;
}

bool canLearn(const MapContext& context, const std::vector<PlaceLink>& links) {
  if (!context.divides || context.has_learnt) return false;
  const std::vector<urban_nav_store::SessionId> ids = context.ids();
  for (const std::vector<std::size_t>& group : sessionsOfGroups(context)) {
    if (group.size() < kSessionsToLearn) continue;
    for (const PlaceLink& link : links)
      if (link.session != link.earlier && link.session != ids[group.back()] &&
          std::any_of(group.begin(), group.end(), [&](std::size_t s) { return ids[s] == link.session; }))
        return true;
  }
  return false;
}

void storeLinks(urban_nav_store::Store& store, const std::vector<PlaceLink>& links) {
  TableStore<PlaceLink> table(store);
  for (const PlaceLink& link : links) table.put(link);
}

std::vector<PlaceLink> knownLinks(const MapContext& context) {
  std::vector<PlaceLink> links = context.learnt;
  if (!context.has_learnt && !context.joins)
    for (const urban_nav_store::SessionId& id : context.previous.ids)
      TableStore<PlaceLink>(*context.store).forEach(id, [&](const PlaceLink& link) { links.push_back(link); });
  links.erase(std::remove_if(links.begin(), links.end(), [](const PlaceLink& link) { return link.accepted == 0; }),
              links.end());
  return links;
}

}  // namespace urban_nav
