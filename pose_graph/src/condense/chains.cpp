// SPDX-License-Identifier: BSD-3-Clause
#include "condense/chains.hpp"

#include "linear/index.hpp"

namespace pose_graph {

namespace {

/// Finds chains; keeps the edges of each pose and marks those already assigned.
template <int D>
class Finder {
 public:
  Finder(const Problem<D>& problem, const std::vector<char>& invertible)
      : problem_(problem),
        invertible_(invertible),
        first_(problem.poses.size() + 1, 0),
        degree_(problem.poses.size(), 0),
        gone_(problem.edges.size(), 0),
        stripped_(problem.poses.size(), 0),
        fixed_(problem.poses.size(), 0) {
    for (const int pose : problem.fixed) fixed_[sz(pose)] = 1;
    for (const Edge<D>& edge : problem.edges) {
      ++first_[sz(edge.from) + 1];
      ++first_[sz(edge.to) + 1];
    }
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    incident_.resize(sz(first_.back()));
    std::vector<int> next(first_.begin(), first_.end() - 1);
    for (std::size_t e = 0; e < problem.edges.size(); ++e) {
      incident_[sz(next[sz(problem.edges[e].from)]++)] = static_cast<int>(e);
      incident_[sz(next[sz(problem.edges[e].to)]++)] = static_cast<int>(e);
    }
    for (std::size_t i = 0; i < degree_.size(); ++i) degree_[i] = first_[i + 1] - first_[i];
  }

  Chains find() {
    stripTwigs();
    findCore();
    for (std::size_t i = 0; i < degree_.size(); ++i)
      if (in_core_[i]) followFrom(static_cast<int>(i));
    for (std::size_t i = 0; i < degree_.size(); ++i)
      if (in_core_[i]) made_.core.push_back(static_cast<int>(i));
    for (std::size_t e = 0; e < gone_.size(); ++e)
      if (!gone_[e]) made_.core_edges.push_back(static_cast<int>(e));
    return std::move(made_);
  }

 private:
  Link linkOver(int e, int from) const {
    const Edge<D>& edge = problem_.edges[sz(e)];
    return {e, edge.to == from, edge.to == from ? edge.from : edge.to};
  }

  int nextEdge(int pose, int but = -1) const {
    for (int k = first_[sz(pose)]; k < first_[sz(pose) + 1]; ++k)
      if (!gone_[sz(incident_[sz(k)])] && incident_[sz(k)] != but) return incident_[sz(k)];
    return -1;
  }

  // A tree is stripped down to its last pose; degrees never become negative, and a pose without edges remains. A fixed
  // pose is never stripped, because a path between two fixed poses is constrained at both ends.
  void stripTwigs() {
    for (std::size_t i = 0; i < degree_.size(); ++i) {
      for (int pose = static_cast<int>(i); degree_[sz(pose)] == 1 && !fixed_[sz(pose)];) {
        const int e = nextEdge(pose);
        const Edge<D>& edge = problem_.edges[sz(e)];
        const int on = edge.from == pose ? edge.to : edge.from;
        made_.twigs.push_back({on, linkOver(e, on)});
        gone_[sz(e)] = 1;
        stripped_[sz(pose)] = 1;
        --degree_[sz(pose)];
        --degree_[sz(on)];
        pose = on;
      }
    }
    made_.twigs = {made_.twigs.rbegin(), made_.twigs.rend()};
  }

  // An intermediate pose has two edges to two neighbours. An isolated ring gets one core pose.
  void findCore() {
    in_core_.assign(degree_.size(), 0);
    for (std::size_t i = 0; i < degree_.size(); ++i) {
      if (stripped_[i]) continue;
      if (degree_[i] != 2 || fixed_[i]) {
        in_core_[i] = 1;
        continue;
      }
      const int one = nextEdge(static_cast<int>(i)), two = nextEdge(static_cast<int>(i), one);
      in_core_[i] = !invertible_[sz(one)] || !invertible_[sz(two)];
    }
    std::vector<char> seen(degree_.size(), 0);
    for (std::size_t i = 0; i < degree_.size(); ++i) {
      if (!in_core_[i]) continue;
      seen[i] = 1;
      for (int k = first_[i]; k < first_[i + 1]; ++k)
        if (!gone_[sz(incident_[sz(k)])]) walk(static_cast<int>(i), incident_[sz(k)], seen);
    }
    for (std::size_t i = 0; i < degree_.size(); ++i) {
      if (seen[i] || stripped_[i]) continue;
      in_core_[i] = 1;
      seen[i] = 1;
      walk(static_cast<int>(i), nextEdge(static_cast<int>(i)), seen);
    }
  }

  void walk(int pose, int e, std::vector<char>& seen) const {
    for (;;) {
      pose = linkOver(e, pose).pose;
      if (in_core_[sz(pose)]) return;
      seen[sz(pose)] = 1;
      e = nextEdge(pose, e);
    }
  }

  // A path of one edge is not a chain. A path that returns to its begin is cut at its last pose. Parallel paths between
  // two poses are kept: the core may have several edges between two poses.
  void followFrom(int pose) {
    for (int k = first_[sz(pose)]; k < first_[sz(pose) + 1]; ++k) {
      const int e = incident_[sz(k)];
      if (gone_[sz(e)] || in_core_[sz(linkOver(e, pose).pose)]) continue;
      const std::size_t start = made_.links.size();
      int at = pose, over = e;
      for (;;) {
        const Link link = linkOver(over, at);
        made_.links.push_back(link);
        gone_[sz(over)] = 1;
        at = link.pose;
        if (in_core_[sz(at)]) break;
        over = nextEdge(at, over);
      }
      if (at == pose) {  // a ring
        gone_[sz(made_.links.back().edge)] = 0;
        made_.links.pop_back();
        in_core_[sz(made_.links.back().pose)] = 1;
        if (made_.links.size() == start + 1) {
          gone_[sz(made_.links.back().edge)] = 0;
          made_.links.pop_back();
        }
      }
      if (made_.links.size() == start) continue;
      made_.begin.push_back(pose);
      made_.first.push_back(static_cast<int>(made_.links.size()));
    }
  }

  const Problem<D>& problem_;
  const std::vector<char>& invertible_;
  std::vector<int> first_, incident_, degree_;
  std::vector<char> gone_, stripped_, in_core_, fixed_;
  Chains made_;
};

}  // namespace

template <int D>
Chains findChains(const Problem<D>& problem, const std::vector<char>& invertible) {
  return Finder<D>(problem, invertible).find();
}

template Chains findChains<2>(const Problem<2>&, const std::vector<char>&);
template Chains findChains<3>(const Problem<3>&, const std::vector<char>&);

}  // namespace pose_graph
