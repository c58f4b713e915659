// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "live/live_places.hpp"

namespace fabmap_node {

using urban_nav_core::PoseRef;
using urban_nav_store::PlaceLink;

std::optional<double> LivePlaces::travelled(const PoseRef& at) const {
  return at.session.empty() ? std::optional<double>(odometry_.travelled(at.stamp)) : map_->travelled(at);
}

void LivePlaces::learn(const urban_nav_core::MetricClosure& closure, PlaceVerdict verdict, const PoseRef& a,
                       const PoseRef& b) {
  const bool is_accepted = closure.verdict == urban_nav_core::ClosureVerdict::Accepted;
  if (!is_accepted && verdict != PlaceVerdict::Withdrawn) return;  // rejected, or not known in all directions
  PlaceLink link{b.session, b.stamp, a.session, a.stamp};
  link.metres = closure.measured.T_a_b.t().norm();
  link.same_direction = closure.measured.T_a_b.R()(0, 0) > 0.0 ? 1 : 0;
  link.accepted = is_accepted ? 1 : 0;
  link.revision = isOfPoseGraph(verdict) ? 1 : 0;
  const auto known = std::find_if(links_.begin(), links_.end(), [&](const PlaceLink& one) {
    return one.session == link.session && one.stamp == link.stamp && one.earlier == link.earlier &&
           one.earlier_stamp == link.earlier_stamp;
  });
  if (known != links_.end() && known->revision > link.revision) return;
  if (known != links_.end()) *known = link;
  else links_.push_back(link);
  apply(link);
  if (session_) keep(link);
}

void LivePlaces::apply(const PlaceLink& link) {
  const PoseRef a{link.earlier, link.earlier_stamp}, b{link.session, link.stamp};
  if (link.accepted == 0) return map_->withdraw(a, b);
  const std::optional<double> travelled_a = travelled(a), travelled_b = travelled(b);
  if (travelled_a && travelled_b)
    map_->confirm({a, b, *travelled_a, *travelled_b, link.metres, link.same_direction != 0});
}

void LivePlaces::keep(PlaceLink link) {
  for (std::string* session : {&link.session, &link.earlier})
    if (session->empty()) *session = session_->id;
  store_.put(std::move(link));
}

void LivePlaces::beginMapSession() {
  if (map_->forgotten() > 0) compact();
  else map_->beginSession("");
}

void LivePlaces::compact() {
  std::set<PoseRef> forgotten;
  for (std::size_t i = 0; i < map_->places(); ++i)
    if (map_->isForgotten(i)) forgotten.insert({map_->sessions()[map_->place(i).session], map_->place(i).stamp});
  useMap(buildMap(earlier_, forgotten));
}

}  // namespace fabmap_node
