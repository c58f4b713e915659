// SPDX-License-Identifier: BSD-3-Clause
#include "incremental/incremental_chain.hpp"

#include <algorithm>
#include <cmath>

#include "manifold/rotation.hpp"

namespace pose_graph {

IncrementalChain::IncrementalChain(const ChainStep* steps, const std::vector<Rigid<3>>& at) {
  links_.reserve(at.size());
  for (const Rigid<3>& T : at) links_.push_back({T, {}});
  sumUp(steps);
}

IncrementalChain IncrementalChain::splitAfter(std::size_t link, const ChainStep* steps) {
  std::vector<Rigid<3>> after;
  const Rigid<3> T_middle_begin = links_[link].at.inverse();
  for (std::size_t l = link + 1; l < links_.size(); ++l) after.push_back(T_middle_begin * links_[l].at);
  links_.resize(link + 1);
  if (links_.size() == 1) links_.clear();
  else sumUp(steps);
  return after.size() == 1 ? IncrementalChain() : IncrementalChain(steps + link + 1, after);
}

double IncrementalChain::bend(const Rigid<3>& wanted) const {
  const Tangent<3> away = twistBetween(wanted, links_.back().at);
  return away.dot(solvedWith<3>(sum_.covariance, away));
}

void IncrementalChain::lay(const Rigid<3>& wanted, const ChainStep* steps) {
  const Tangent<3> pull = solvedWith<3>(sum_.covariance, twistBetween(wanted, links_.back().at) - sum_.shift);
  Rigid<3> before, old_before;
  for (Link& link : links_) {
    before = before * pulledStep(link.sum, pull, old_before, link.at);
    before.R = renormalised<3>(before.R);
    old_before = link.at;
    link.at = before;
  }
  sumUp(steps);
}

void IncrementalChain::sumUp(const ChainStep* steps) {
  sum_ = {};
  reach_ = 0.0;
  double cost = 0.0;
  Rigid<3> before;
  for (std::size_t l = 0; l < links_.size(); ++l) {
    Link& link = links_[l];
    link.sum = linkSum(steps[l].edge, false, steps[l].covariance, before, link.at, &cost);
    sum_ += link.sum;
    before = link.at;
    reach_ = std::max(reach_, link.at.t.squaredNorm());
  }
  reach_ = std::sqrt(reach_);
  if (!links_.empty()) edge_ = composedEdge(sum_, before);
}

}  // namespace pose_graph
