// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/selection_warnings.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>
#include <utility>

#include "linear/disjoint_sets.hpp"
#include "robust/evidence/variances.hpp"
#include "robust/generators/session_links.hpp"

namespace pose_graph {

using urban_nav_core::ClosureVerdict;

namespace {

struct Rejections {
  std::size_t rejected = 0, all = 0;
};

// Counts rejected edges, without those of odometry.
template <int D>
Rejections count(const std::vector<int>& edges, const FileProblem<D>& file, const RobustSolution<D>& robust) {
  Rejections made;
  for (const int edge : edges) {
    if (edge < 0 || file.roles[static_cast<std::size_t>(edge)] == EdgeRole::Trusted) continue;
    ++made.all;
    made.rejected += robust.edges[static_cast<std::size_t>(edge)].verdict == ClosureVerdict::Rejected;
  }
  return made;
}

// Adds a warning about parts that only closures could have joined and whose closures are all rejected.
template <int D>
void addUnjoined(const FileProblem<D>& file, const RobustSolution<D>& robust, std::vector<std::string>& warnings) {
  const std::vector<int> parts = sessionParts(file.problem, file.roles);
  DisjointSets joined(parts.size());
  std::vector<const Edge<D>*> left_out;
  for (std::size_t e = 0; e < file.roles.size(); ++e) {
    const Edge<D>& edge = file.problem.edges[e];
    if (file.roles[e] != EdgeRole::Candidate) continue;
    if (robust.edges[e].verdict == ClosureVerdict::Rejected) left_out.push_back(&edge);
    else joined.join(parts[sz(edge.from)], parts[sz(edge.to)]);
  }
  std::set<int> apart;
  std::size_t rejected = 0;
  for (const Edge<D>* edge : left_out) {
    const int a = joined.root(parts[sz(edge->from)]), b = joined.root(parts[sz(edge->to)]);
    if (a == b) continue;
    apart.insert({a, b});
    ++rejected;
  }
  if (rejected > 0)
    warnings.push_back(std::to_string(apart.size()) +
                       " parts of the graph that odometry does not join stay apart: all " + std::to_string(rejected) +
                       " closures between them are rejected");
}

// Describes a slip by the nearest ends of accepted closures on both sides: the closures do not determine which step
// between them slipped.
template <int D>
std::string describeSlip(const FileProblem<D>& file, const RobustSolution<D>& robust, std::size_t edge) {
  const int from = std::min(file.problem.edges[edge].from, file.problem.edges[edge].to);
  const int to = std::max(file.problem.edges[edge].from, file.problem.edges[edge].to);
  int first = 0, last = static_cast<int>(file.ids.size()) - 1;
  for (std::size_t e = 0; e < file.roles.size(); ++e) {
    if (file.roles[e] != EdgeRole::Candidate || robust.edges[e].verdict == ClosureVerdict::Rejected) continue;
    for (const int end : {file.problem.edges[e].from, file.problem.edges[e].to}) {
      if (end <= from) first = std::max(first, end);
      if (end >= to) last = std::min(last, end);
    }
  }
  const auto id = [&](int pose) { return std::to_string(file.ids[static_cast<std::size_t>(pose)]); };
  return "odometry slipped between " + id(first) + " and " + id(last) + ", most likely from " + id(from) + " to " +
         id(to) + ": this edge is rejected";
}

std::string twoDigits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, value < 100.0 ? "%.2g" : "%.0f", value);
  return text;
}

// Errors smaller than stated are reported only if odometry and closures are weighted inconsistently because of them.
void addScales(const std::string& kind, const std::optional<double>& odometry, const std::optional<double>& closures,
               std::vector<std::string>& warnings) {
  const bool larger_odometry = odometry && *odometry > kStatedWithin;
  const bool larger_closures = closures && *closures > kStatedWithin;
  const std::string stated = " times the deviations that the information states";
  if (larger_odometry)
    warnings.push_back("the errors of odometry's " + kind + " are " + twoDigits(*odometry) + stated +
                       ": divide its information by " + twoDigits(*odometry * *odometry));
  if (larger_closures)
    warnings.push_back("the errors of the closures' " + kind + " are " + twoDigits(*closures) + stated +
                       ": divide their information by " + twoDigits(*closures * *closures));
  if (larger_odometry || larger_closures || !odometry || !closures) return;
  const double ratio = *odometry / *closures;
  if (ratio > kStatedWithin || ratio < 1.0 / kStatedWithin)
    warnings.push_back("odometry and closures are weighted inconsistently: the errors of odometry's " + kind + " are " +
                       twoDigits(*odometry) + stated + ", those of the closures' " + twoDigits(*closures) + " times");
}

}  // namespace

std::vector<std::string> selectionWarnings(const SelectionReport& selection, std::size_t rejected,
                                           std::size_t closures) {
  std::vector<std::string> warnings;
  if (selection.undecided)
    warnings.push_back("nothing could be decided: no set of the " + std::to_string(closures) +
                       " closures is more likely than chance; the result is odometry only");
  if (selection.unweighed)
    warnings.push_back(
        "the graph is too large to compare sets of closures against odometry: " + std::to_string(rejected) + " of " +
        std::to_string(closures) + " are rejected, and the others may fit by chance");
  if (selection.has_rival)
    warnings.push_back(
        "another set of closures, a rival, is nearly as likely as the accepted one, or odometry contradicts closures "
        "that no other closure confirms: closures that are not in both sets are left out if many others remain; "
        "otherwise the accepted set is a guess, with which the errors of odometry are " +
        twoDigits(std::sqrt(selection.odometry_factor)) + " times the stated deviations, and those of closures " +
        twoDigits(std::sqrt(selection.closure_factor)) + " times");
  return warnings;
}

template <int D>
std::vector<std::string> selectionWarnings(const FileProblem<D>& file, const RobustSolution<D>& robust,
                                           const DeviationScales& scales) {
  const Rejections closures = count(file.edges, file, robust);
  std::vector<std::string> warnings = selectionWarnings(robust.selection, closures.rejected, closures.all);
  if (!robust.selection.undecided && 2 * closures.rejected > closures.all)
    warnings.push_back(std::to_string(closures.rejected) + " of " + std::to_string(closures.all) +
                       " closures are rejected: more than half");
  if (!robust.selection.undecided) addUnjoined(file, robust, warnings);
  for (const auto& [edges, name] :
       {std::make_pair(&file.priors, "priors"), std::make_pair(&file.point_edges, "measurements of landmarks")}) {
    const Rejections some = count(*edges, file, robust);
    if (some.rejected > 0)
      warnings.push_back(std::to_string(some.rejected) + " of " + std::to_string(some.all) + " " + name +
                         " are rejected: they contradict odometry and the others");
  }
  if (robust.selection.undecided_priors > 0)
    warnings.push_back(std::to_string(robust.selection.undecided_priors) +
                       " priors or measurements of landmarks contradict odometry and the others, and which are false "
                       "cannot be decided: all are used");
  for (std::size_t e = 0; e < file.roles.size(); ++e)
    if (file.roles[e] == EdgeRole::Trusted && robust.edges[e].verdict == ClosureVerdict::Rejected)
      warnings.push_back(describeSlip(file, robust, e));
  addScales("translation", scales.odometry_translation, scales.closure_translation, warnings);
  addScales("rotation", scales.odometry_rotation, scales.closure_rotation, warnings);
  return warnings;
}

template std::vector<std::string> selectionWarnings<2>(const FileProblem<2>&, const RobustSolution<2>&,
                                                       const DeviationScales&);
template std::vector<std::string> selectionWarnings<3>(const FileProblem<3>&, const RobustSolution<3>&,
                                                       const DeviationScales&);

}  // namespace pose_graph
