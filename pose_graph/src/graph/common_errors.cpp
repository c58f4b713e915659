// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <map>
#include <utility>

#include "pose_graph/pose_graph.hpp"

namespace pose_graph {

using urban_nav_core::ConsideredConstant;
using urban_nav_core::RelativePose;
using urban_nav_core::Vector6d;

namespace {

constexpr const char* kScale = "scale";  // scale of all lengths that a rig measures, closures included

/// A constant of a rig: rig and constant name.
using ConstantKey = std::pair<std::string, std::string>;

const ConsideredConstant* findConstant(const RelativePose& step, const std::string& name) {
  for (const ConsideredConstant& constant : step.constants)
    if (constant.name == name) return &constant;
  return nullptr;
}

/// Returns each constant from the newest step of the session with the most precise estimate.
std::map<ConstantKey, ConsideredConstant> findEstimates(const std::vector<std::vector<RelativePose>>& steps,
                                                        const std::vector<std::string>& rigs) {
  std::map<ConstantKey, ConsideredConstant> best;
  for (std::size_t t = 0; t < steps.size(); ++t) {
    std::map<ConstantKey, const ConsideredConstant*> newest;
    for (const RelativePose& step : steps[t])
      for (const ConsideredConstant& constant : step.constants) newest[{rigs[t], constant.name}] = &constant;
    for (const auto& [key, constant] : newest) {
      const auto known = best.find(key);
      if (known == best.end() || constant->sigma < known->second.sigma) best[key] = *constant;
    }
  }
  return best;
}

bool hasAnyEdge(const CommonError<3>& error) {
  for (const Vector6d& each : error.of_edge)
    if (!each.isZero(0.0)) return true;
  return false;
}

}  // namespace

void PoseGraph::setRig(const SessionId& session, const std::string& rig) {
  if (hasSession(session)) rigs_[track_of_.at(session)] = rig;
}

// The error of a step, s (used - true), is the sum of s (used - mean), which is known but not corrected, and of
// s (mean - true).
std::vector<CommonError<3>> PoseGraph::commonErrors() const {
  std::vector<CommonError<3>> errors;
  for (const auto& [key, known] : findEstimates(measured_, rigs_)) {
    CommonError<3> unknown, unused;
    for (std::size_t t = 0; t < tracks_.size(); ++t)
      for (std::size_t i = 0; i < steps_[t].size(); ++i) {
        if (!steps_[t][i].joins) continue;
        const ConsideredConstant* constant =
            rigs_[t] == key.first ? findConstant(measured_[t][i], key.second) : nullptr;
        unknown.of_edge.push_back(constant ? Vector6d(known.sigma * constant->sensitivity) : Vector6d::Zero());
        unused.of_edge.push_back(constant ? Vector6d((constant->used - known.mean) * constant->sensitivity)
                                          : Vector6d::Zero());
      }
    if (key.second == kScale)
      for (const auto& [id, closure] : closures_) {
        unknown.of_edge.push_back(Vector6d::Zero());
        if (closure.kind == EdgeKind::Stereo && rigs_[track_of_.at(closure.a.session)] == key.first)
          unknown.of_edge.back().head<3>() = known.sigma * closure.measured.T_a_b.t();
      }
    for (CommonError<3>* each : {&unknown, &unused})
      if (hasAnyEdge(*each)) errors.push_back(std::move(*each));
  }
  return errors;
}

}  // namespace pose_graph
