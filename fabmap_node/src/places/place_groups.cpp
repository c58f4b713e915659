// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/places/place_groups.hpp"

#include <algorithm>
#include <iterator>

namespace fabmap_node {

std::size_t PlaceGroups::confirm(const ConfirmedPair& pair, const Similarity& similarity) {
  std::size_t forgotten = kNone;
  if (pair.a == pair.b || !known_.insert({pair.a, pair.b}).second) return forgotten;
  confirmed_.push_back(pair);
  add(pair, similarity, forgotten);
  return forgotten;
}

void PlaceGroups::withdraw(std::size_t a, std::size_t b, const Similarity& similarity) {
  const auto end = std::remove_if(confirmed_.begin(), confirmed_.end(),
                                  [&](const ConfirmedPair& one) { return one.a == a && one.b == b; });
  if (end == confirmed_.end()) return;
  known_.erase({a, b});
  confirmed_.erase(end, confirmed_.end());
  groups_.clear();
  of_observation_.clear();
  std::size_t forgotten = kNone;
  for (const ConfirmedPair& one : confirmed_) add(one, similarity, forgotten);
}

void PlaceGroups::add(const ConfirmedPair& pair, const Similarity& similarity, std::size_t& forgotten) {
  if (pair.metres > kReach) return;
  const auto a = of_observation_.find(pair.a), b = of_observation_.find(pair.b);
  if (a == of_observation_.end() && b == of_observation_.end()) {
    groups_.push_back({{pair.a, pair.b}, {0.0, pair.metres}});
    of_observation_[pair.a] = {groups_.size() - 1, false, 0.0};
    of_observation_[pair.b] = {groups_.size() - 1, false, pair.metres};
    return;
  }
  if (a != of_observation_.end() && b != of_observation_.end()) return;  // each keeps the place it has
  const Membership known = a != of_observation_.end() ? a->second : b->second;
  const double reach = known.reach + pair.metres;
  if (reach <= kReach) forgotten = take(known.group, a != of_observation_.end() ? pair.b : pair.a, reach, similarity);
}

std::size_t PlaceGroups::take(std::size_t group, std::size_t observation, double reach, const Similarity& similarity) {
  Group& place = groups_[group];
  of_observation_[observation] = {group, false, reach};
  place.members.push_back(observation);
  place.reach.push_back(reach);
  if (place.members.size() <= kMostAppearances) return kNone;
  const auto compared = [&](std::size_t i, std::size_t j) {
    const auto key = std::minmax(place.members[i], place.members[j]);
    const auto known = similarity_.find(key);
    return known != similarity_.end() ? known->second
                                      : similarity_.emplace(key, similarity(key.first, key.second)).first->second;
  };
  std::size_t spare = place.members.size() - 1;
  double most = -1.0;
  for (std::size_t j = 1; j < place.members.size(); ++j)  // never the first, from which distances are counted
    for (std::size_t i = 0; i < j; ++i) {
      const double similarity_of_pair = compared(i, j);
      if (similarity_of_pair <= most) continue;
      most = similarity_of_pair;
      spare = j;
    }
  const std::size_t forgotten = place.members[spare];
  of_observation_[forgotten].is_forgotten = true;
  place.members.erase(place.members.begin() + static_cast<std::ptrdiff_t>(spare));
  place.reach.erase(place.reach.begin() + static_cast<std::ptrdiff_t>(spare));
  for (auto one = similarity_.begin(); one != similarity_.end();)
    one = one->first.first == forgotten || one->first.second == forgotten ? similarity_.erase(one) : std::next(one);
  return forgotten;
}

const std::vector<std::size_t>& PlaceGroups::appearances(std::size_t observation) const {
  static const std::vector<std::size_t> kAlone;
  const auto found = of_observation_.find(observation);
  return found == of_observation_.end() ? kAlone : groups_[found->second.group].members;
}

bool PlaceGroups::isForgotten(std::size_t observation) const {
  const auto found = of_observation_.find(observation);
  return found != of_observation_.end() && found->second.is_forgotten;
}

}  // namespace fabmap_node
