// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "base/json.hpp"
#include "base/parameter_set.hpp"
#include "urban_nav_core/types/closure.hpp"
#include "urban_nav_store/session.hpp"

namespace urban_nav {

/// A store of a plan or a piece.
struct PlannedStore {
  std::string path;    ///< relative to the folder of the plan
  std::string digest;  ///< of its bytes (digestOfFile)
};

/// A session of a plan.
struct PlannedSession {
  urban_nav_store::SessionId id;
  std::string name;       ///< its name in candidates
  std::size_t store = 0;  ///< index of its store
};

/// Common content of a plan and its pieces.
struct PlanContent {
  std::vector<PlannedStore> stores;
  std::vector<PlannedSession> sessions;
  std::vector<std::string> parameters;  ///< those that differ from the default: "loop_metric.icp=off"
  std::string camera;  ///< camera to which the views of all sessions are converted (calibrationFingerprint)
  std::vector<urban_nav_core::MetricClosure> candidates;
};

/// An independent part of a join: the candidates between the sessions of two stores, or of one.
struct JoinPiece : PlanContent {
  std::string plan;  ///< digest of the plan
};

/// A join split into pieces. Its candidates are those of all pieces, in the order in which they were found.
struct JoinPlan : PlanContent {
  std::string digest;               ///< of the following members and of the pieces
  std::vector<std::string> pieces;  ///< names of files in the folder of the plan
  std::vector<std::string> warnings;
};

/// Returns a digest of a file's bytes. Throws UserError if it cannot be read.
std::string digestOfFile(const std::string& path);

/// Sets `plan.pieces` and `plan.digest`, and returns the content of each piece.
std::vector<JoinPiece> splitPlan(JoinPlan& plan);

Json toJson(const JoinPlan& plan);
Json toJson(const JoinPiece& piece);
/// Read the output of toJson(). Throw UserError naming the file for other content.
JoinPlan readPlan(const std::string& path);
JoinPiece readPiece(const std::string& path);

/// Returns the assignments of a set that differ from the defaults, without those that do not affect results.
std::vector<std::string> chosenParameters(const ParameterSet& parameters);

}  // namespace urban_nav
