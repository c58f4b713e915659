// SPDX-License-Identifier: BSD-3-Clause
#include "condense/condensed.hpp"

#include "linear/index.hpp"
#include "manifold/rotation.hpp"
#include "urban_nav_core/parallel/for_each.hpp"

namespace pose_graph {

namespace {

constexpr std::size_t kChainGrain = 16;  // chains per task of a thread

}  // namespace

template <int D>
Condensed<D>::Condensed(const Problem<D>& problem, const std::vector<double>& weights) : problem_(&problem) {
  std::vector<char> invertible(problem.edges.size());
  std::vector<TangentMatrix<D>> inverses(problem.edges.size());
  for (std::size_t e = 0; e < invertible.size(); ++e)
    invertible[e] = (weights.empty() || weights[e] == 1.0) && !problem.edges[e].hasLever() &&
                    invert<D>(problem.edges[e].information, inverses[e]);
  chains_ = findChains(problem, invertible);
  core_of_.assign(problem.poses.size(), -1);
  for (std::size_t c = 0; c < chains_.core.size(); ++c) core_of_[sz(chains_.core[c])] = static_cast<int>(c);
  covariance_.reserve(chains_.links.size());
  for (const Link& link : chains_.links) covariance_.push_back(inverses[sz(link.edge)]);
  at_.resize(chains_.links.size());
  link_sums_.resize(chains_.links.size());
  chain_sums_.resize(chains_.size());
  chain_costs_.assign(chains_.size(), 0.0);
  layByOdometry();
}

template <int D>
Rigid<D> Condensed<D>::measured(const Link& link) const {
  const Edge<D>& edge = problem_->edges[sz(link.edge)];
  return link.against ? edge.measured({}) * edge.Z.inverse() : edge.predicted({});
}

template <int D>
void Condensed<D>::layByOdometry() {
  for (std::size_t s = 0; s < chains_.size(); ++s) {
    Rigid<D> at;
    for (std::size_t l = sz(chains_.first[s]); l < sz(chains_.first[s + 1]); ++l) {
      at = at * measured(chains_.links[l]);
      at.R = renormalised<D>(at.R);
      at_[l] = at;
    }
  }
}

template <int D>
void Condensed<D>::layBy(const std::vector<Rigid<D>>& poses) {
  for (std::size_t s = 0; s < chains_.size(); ++s) {
    const Rigid<D> T_begin_map = poses[sz(chains_.begin[s])].inverse();
    for (std::size_t l = sz(chains_.first[s]); l < sz(chains_.first[s + 1]); ++l)
      at_[l] = T_begin_map * poses[sz(chains_.links[l].pose)];
  }
}

template <int D>
double Condensed<D>::relinearise() {
  urban_nav_core::forEach(chains_.size(), kChainGrain, [&](std::size_t s) {
    ChainSum<D> total;
    double cost = 0.0;
    Rigid<D> before;
    for (std::size_t l = sz(chains_.first[s]); l < sz(chains_.first[s + 1]); ++l) {
      const Link& link = chains_.links[l];
      link_sums_[l] = linkSum(problem_->edges[sz(link.edge)], link.against, covariance_[l], before, at_[l], &cost);
      total += link_sums_[l];
      before = at_[l];
    }
    chain_sums_[s] = total;
    chain_costs_[s] = cost;
  });
  double cost = 0.0;
  for (const double one : chain_costs_) cost += one;
  return cost;
}

template <int D>
Problem<D> Condensed<D>::core(const std::vector<Rigid<D>>& poses) const {
  Problem<D> made;
  for (const int pose : chains_.core) made.poses.push_back(poses[sz(pose)]);
  for (const int pose : problem_->fixed) {
    const int at = core_of_[sz(pose)];
    made.fixed.push_back(at);
    made.poses[sz(at)] = problem_->poses[sz(pose)];
  }
  for (const int e : chains_.core_edges) {
    Edge<D> edge = problem_->edges[sz(e)];
    edge.from = core_of_[sz(edge.from)];
    edge.to = core_of_[sz(edge.to)];
    made.edges.push_back(edge);
  }
  for (std::size_t s = 0; s < chains_.size(); ++s) {
    Edge<D> edge;
    edge.from = core_of_[sz(chains_.begin[s])];
    edge.to = core_of_[sz(chains_.end(s))];
    made.edges.push_back(edge);
  }
  renew(made);
  return made;
}

template <int D>
void Condensed<D>::renew(Problem<D>& core) const {
  for (std::size_t s = 0; s < chains_.size(); ++s) {
    Edge<D>& edge = core.edges[chains_.core_edges.size() + s];
    const Edge<D> composed = composedEdge(chain_sums_[s], at_[sz(chains_.first[s + 1]) - 1]);
    edge.Z = composed.Z;
    edge.information = composed.information;
  }
}

template <int D>
void Condensed<D>::expand(const std::vector<Rigid<D>>& core_poses) {
  urban_nav_core::forEach(chains_.size(), kChainGrain, [&](std::size_t s) {
    const Rigid<D> wanted =
        core_poses[sz(core_of_[sz(chains_.begin[s])])].inverse() * core_poses[sz(core_of_[sz(chains_.end(s))])];
    const std::size_t last = sz(chains_.first[s + 1]) - 1;
    const Tangent<D> move = twistBetween(wanted, at_[last]);
    const Tangent<D> pull = solvedWith<D>(chain_sums_[s].covariance, move - chain_sums_[s].shift);
    // Each link moves by its share and carries the following poses along.
    Rigid<D> before, old_before;
    for (std::size_t l = sz(chains_.first[s]); l <= last; ++l) {
      before = before * pulledStep(link_sums_[l], pull, old_before, at_[l]);
      before.R = renormalised<D>(before.R);
      old_before = at_[l];
      at_[l] = before;
    }
  });
}

template <int D>
double Condensed<D>::mismatch(const std::vector<Rigid<D>>& core_poses) const {
  double total = 0.0;
  for (std::size_t s = 0; s < chains_.size(); ++s) {
    const Rigid<D> wanted =
        core_poses[sz(core_of_[sz(chains_.begin[s])])].inverse() * core_poses[sz(core_of_[sz(chains_.end(s))])];
    const Rigid<D>& end = at_[sz(chains_.first[s + 1]) - 1];
    const Tangent<D> away = twistBetween(wanted, end);
    total += away.dot(solvedWith<D>(chain_sums_[s].covariance, away));
  }
  return total;
}

template <int D>
std::vector<Rigid<D>> Condensed<D>::assemble(const std::vector<Rigid<D>>& core_poses) const {
  std::vector<Rigid<D>> poses = problem_->poses;
  for (std::size_t c = 0; c < core_poses.size(); ++c) poses[sz(chains_.core[c])] = core_poses[c];
  for (std::size_t s = 0; s < chains_.size(); ++s) {
    const Rigid<D>& begin = poses[sz(chains_.begin[s])];
    for (std::size_t l = sz(chains_.first[s]); l + 1 < sz(chains_.first[s + 1]); ++l)
      poses[sz(chains_.links[l].pose)] = begin * at_[l];
  }
  for (const Chains::Twig& twig : chains_.twigs) poses[sz(twig.link.pose)] = poses[sz(twig.from)] * measured(twig.link);
  return poses;
}

template class Condensed<2>;
template class Condensed<3>;

}  // namespace pose_graph
