// SPDX-License-Identifier: BSD-3-Clause
#include "map/map_division.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

namespace urban_nav {

using urban_nav_core::ClosureVerdict;
using urban_nav_core::MetricClosure;
using urban_nav_core::PoseRef;

namespace {

using Poses = std::pair<PoseRef, PoseRef>;

constexpr std::array<const char*, 3> kRepeated = {"places", "loops", "graph"};
constexpr const char* kApart = "separate_maps";

Poses closurePoses(const MetricClosure& closure) { return std::minmax(closure.a, closure.b); }

std::size_t findGroup(const MapContext& context, std::size_t session) {
  return context.groups.empty() ? 0 : context.groups[session];
}

/// Returns the closure as one that joins no maps.
MetricClosure rejected(MetricClosure closure, const std::string& reason) {
  if (closure.verdict != ClosureVerdict::Rejected) {
    closure.reason_name = kApart;
    closure.sentence = reason;
  }
  closure.verdict = ClosureVerdict::Rejected;
  closure.measured.information.setZero();
  return closure;
}

}  // namespace

bool canDivide(const MapContext& context, const StageList& stages) {
  const auto has = [&](const char* name) {
    return std::any_of(stages.begin(), stages.end(),
                       [&](const Stage* stage) { return stage->describe().name == name; });
  };
  return context.names.size() > 1 && (context.joins || context.previous.runs.empty()) &&
         std::all_of(kRepeated.begin(), kRepeated.end(), has);
}

bool isRepeatedByMap(const std::string& name) {
  return std::find(kRepeated.begin(), kRepeated.end(), name) != kRepeated.end();
}

std::vector<std::size_t> dividedGroups(const MapContext& context, const std::vector<std::size_t>& maps) {
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> first;
  std::vector<std::size_t> groups;
  for (std::size_t s = 0; s < maps.size(); ++s)
    groups.push_back(first.emplace(std::make_pair(findGroup(context, s), maps[s]), s).first->second);
  return groups;
}

std::vector<std::vector<std::size_t>> sessionsOfGroups(const MapContext& context) {
  std::vector<std::vector<std::size_t>> groups;
  std::map<std::size_t, std::size_t> place;
  for (std::size_t s = 0; s < context.names.size(); ++s) {
    const auto [known, is_new] = place.emplace(findGroup(context, s), groups.size());
    if (is_new) groups.emplace_back();
    groups[known->second].push_back(s);
  }
  return groups;
}

bool hasKnownPlaces(const MapContext& context, std::size_t session) {
  if (session < context.is_frozen.size() && context.is_frozen[session]) return true;
  return !context.joins && context.isPrevious(session);
}

std::vector<std::size_t> recognitionOrder(const MapContext& context, std::vector<std::size_t> group) {
  std::stable_partition(group.begin(), group.end(),
                        [&](std::size_t session) { return hasKnownPlaces(context, session); });
  return group;
}

void divideGroups(const std::vector<std::size_t>& groups, const std::vector<MetricClosure>& closures,
                  const std::vector<ClosureAssessment>& assessments, MapContext& context) {
  std::map<std::string, std::size_t> group;
  for (std::size_t s = 0; s < context.names.size(); ++s) group[context.names[s]] = groups[s];
  std::map<Poses, std::string> reasons;
  for (std::size_t i = 0; i < std::min(closures.size(), assessments.size()); ++i)
    reasons[closurePoses(closures[i])] = assessments[i].reason;
  std::set<Poses> elsewhere;  // those that are candidates in the next run, too, and those known
  for (const MetricClosure& closure : context.given) elsewhere.insert(closurePoses(closure));
  for (const MetricClosure& closure : context.between_groups) elsewhere.insert(closurePoses(closure));
  for (const MetricClosure& closure : context.closures) {
    const auto a = group.find(closure.a.session), b = group.find(closure.b.session);
    if (a == group.end() || b == group.end() || a->second == b->second) continue;
    if (elsewhere.insert(closurePoses(closure)).second)
      context.between_groups.push_back(rejected(closure, reasons[closurePoses(closure)]));
  }
  context.groups = groups;
  context.learnt.reset();  // these groups do not know the others
}

}  // namespace urban_nav
