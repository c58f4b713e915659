// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <vector>

#include "pose_graph/pose_graph.hpp"

namespace pose_graph {

/// Sets a correction's reason, sentence and causing_edges. `accepted_before`: closures accepted before the relaxation,
/// ascending. `removed`: those of them removed manually since then. `closures`: present verdicts. `levelled`: the map
/// was also rotated.
void explain(Relaxed::Correction& correction, const std::vector<ClosureId>& accepted_before,
             const std::vector<Closure>& removed, const std::map<ClosureId, Closure>& closures, bool levelled);

}  // namespace pose_graph
