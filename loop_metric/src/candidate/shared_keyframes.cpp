// SPDX-License-Identifier: BSD-3-Clause
#include "loop_metric/candidate/shared_keyframes.hpp"

#include <algorithm>
#include <map>
#include <tuple>

#include "loop_metric/evidence.hpp"

namespace loop_metric {

using urban_nav_core::ClosureMethod;
using urban_nav_core::ClosureVerdict;
using urban_nav_core::MetricClosure;
using urban_nav_core::PoseRef;

namespace {

constexpr double kLeastViewShare = 1e-3;  // not zero: zero information means that nothing was measured

auto orderKey(const PoseRef& at) { return std::tie(at.session, at.stamp); }

}  // namespace

bool operator<(const SharedKeyframes& one, const SharedKeyframes& other) {
  return std::tuple_cat(orderKey(one.first), orderKey(one.second)) <
         std::tuple_cat(orderKey(other.first), orderKey(other.second));
}

std::optional<SharedKeyframes> findKeyframes(const MetricClosure& closure) {
  if (closure.verdict != ClosureVerdict::Accepted || closure.method != ClosureMethod::Stereo) return std::nullopt;
  const std::string_view text = evidenceIn(closure.evidence);
  if (text.empty()) return std::nullopt;
  const Evidence evidence = parseEvidence(text);
  const auto accepted = std::find_if(evidence.tries.rbegin(), evidence.tries.rend(),
                                     [](const Evidence::Try& each) { return each.method == ClosureMethod::Stereo; });
  if (accepted == evidence.tries.rend()) return std::nullopt;
  SharedKeyframes views{accepted->keyframe_a, accepted->keyframe_b};
  if (orderKey(views.second) < orderKey(views.first)) std::swap(views.first, views.second);
  return views;
}

void discountSharedKeyframes(std::vector<MetricClosure>& closures) {
  std::map<SharedKeyframes, std::vector<MetricClosure*>> by_views;
  for (MetricClosure& closure : closures)
    if (const auto views = findKeyframes(closure)) by_views[*views].push_back(&closure);
  for (const auto& [views, resting] : by_views)
    for (MetricClosure* closure : resting) closure->measured.information /= static_cast<double>(resting.size());
}

void SharedKeyframeDiscount::discountAgainst(MetricClosure& closure) {
  const auto views = findKeyframes(closure);
  if (views && !known_.insert(*views).second) closure.measured.information *= kLeastViewShare;
}

}  // namespace loop_metric
