// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "join/join_plan.hpp"
#include "join/join_run.hpp"

namespace urban_nav {

/// Splits a join into pieces: writes plan.json and the pieces into the folder `options.out`, created if missing. Paths
/// of stores are relative to it, so that the folder and the stores can be copied together. The output does not depend
/// on the order of the stores. Throws the errors of Join.
JoinPlan planJoin(JoinOptions options, AllStages stages, Console& console);

/// Verdicts on the candidates of a piece.
struct PieceResult {
  std::size_t candidates = 0, accepted_stereo = 0, accepted_icp = 0, rejected = 0;
  double ms_median = 0.0;  ///< per candidate
};

/// Measures the candidates of a piece and writes the result `path`.done atomically and reproducibly. Throws UserError
/// for a file that is not a piece, and for stores other than those of the plan.
PieceResult measurePiece(const std::string& path, ParameterSet parameters, Console& console);

/// Relaxes the sessions of a plan with the closures that its pieces have measured, and writes the store `options.out`,
/// like joinStores(). Requires empty `options.stores`. Throws DataError for a piece without result, UserError if a
/// result belongs to another plan or a store has changed since the plan was made.
JoinRun finishJoin(const std::string& folder, JoinOptions options, AllStages stages, Console& console);

}  // namespace urban_nav
